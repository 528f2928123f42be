// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/integration/scratch_folder.hpp"

#include <catch2/catch.hpp>

#include <fstream>
#include <iterator>
#include <string>

/// `joined` of TalkerComp and EchoRtc, as tandem link profile writes it.
struct JoinedFolder : ScratchFolder {
    JoinedFolder() {
        add_component("TalkerComp");
        add_component("EchoRtc");
        REQUIRE(tandem({"link", "profile", "TalkerComp", "EchoRtc", "--out", "joined"}).exit_code() == 0);
    }
    /// Replaces a text in a file of the folder.
    void edit(const std::string& file, const std::string& text, const std::string& replacement) const {
        std::ifstream in(path() / file);
        std::string content{std::istreambuf_iterator<char>(in), {}};
        const auto at = content.find(text);
        REQUIRE(at != std::string::npos);
        std::ofstream(path() / file) << content.replace(at, text.size(), replacement);
    }
};
