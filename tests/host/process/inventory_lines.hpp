// SPDX-License-Identifier: Apache-2.0
// What another process sees of the parts of this one, by its open files.
#pragma once
#include "host/process/file_descriptor.hpp"
#include "host/process/published/inventory.hpp"

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <unistd.h>

#include <filesystem>
#include <set>
#include <sstream>
#include <string>

namespace tandem::test {

struct InventoryRead {
    process::InventoryHead head{};      ///< of the last file
    std::multiset<std::string> lines{}; ///< of all files, without spaces at the end
    std::string rest{};                 ///< bytes beyond the end of the text of the last file
};

/// Reads the inventories of this process. A library that lists parts has a file of its own.
inline InventoryRead read_inventory() {
    using process::InventoryHead;
    InventoryRead read;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
        std::error_code gone;
        if (std::filesystem::read_symlink(entry.path(), gone) !=
            "/memfd:" + std::string(InventoryHead::file_name) + " (deleted)")
            continue;
        const process::FileDescriptor file(open(entry.path().c_str(), O_RDONLY | O_CLOEXEC));
        REQUIRE(pread(file.get(), &read.head, sizeof read.head, 0) == sizeof read.head);
        REQUIRE(read.head.text_bytes <= InventoryHead::max_text_bytes);
        std::string text(read.head.text_bytes, '\0');
        REQUIRE(pread(file.get(), text.data(), text.size(), sizeof read.head) ==
                static_cast<ssize_t>(text.size()));
        read.rest.resize(InventoryHead::file_bytes - sizeof read.head - text.size());
        REQUIRE(pread(file.get(), read.rest.data(), read.rest.size(),
                      static_cast<off_t>(sizeof read.head + text.size())) ==
                static_cast<ssize_t>(read.rest.size()));
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) {
            line.erase(line.find_last_not_of(' ') + 1);
            if (!line.empty()) read.lines.insert(line);
        }
    }
    return read;
}

/// Returns how many parts begin with this text.
inline std::size_t count_parts(const std::string& begin) {
    std::size_t count = 0;
    for (const auto& line : read_inventory().lines) count += line.starts_with(begin) ? 1 : 0;
    return count;
}

} // namespace tandem::test
