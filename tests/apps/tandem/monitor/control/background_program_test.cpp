// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/control/background_program.hpp"

#include "../http_client.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <string>

using tandem::monitor::BackgroundProgram;
using tandem::shm::test::eventually;

namespace {

std::string text_of(int file) {
    std::string text(1000, '\0');
    const auto bytes = pread(file, text.data(), text.size(), 0);
    text.resize(bytes < 0 ? 0 : static_cast<std::size_t>(bytes));
    return text;
}

} // namespace

TEST_CASE("a program that was asked to end is not asked again when the monitor ends") {
    const tandem::process::FileDescriptor output(memfd_create("output", MFD_CLOEXEC));
    {
        BackgroundProgram program(
            {"sh", "-c",
             "trap 'echo asked; left=5' TERM; left=600; echo ready\n"
             "while [ $left -gt 0 ]; do sleep 0.1; left=$((left - 1)); done; echo ended"},
            output.get());
        REQUIRE(eventually([&] { return text_of(output.get()) == "ready\n"; }));
        program.stop();
        REQUIRE(eventually([&] { return text_of(output.get()) == "ready\nasked\n"; }));
        program.stop();
    }
    CHECK(text_of(output.get()) == "ready\nasked\nended\n");
}
