// SPDX-License-Identifier: Apache-2.0
#include "host/process/child_process.hpp"
#include "host/process/output_pipe.hpp"
#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

TEST_CASE("rtm_host opens no file under the number of a standard input that is closed") {
    tandem::process::OutputPipe pipe;
    const tandem::process::ChildProcess host(
        {"/bin/sh", "-c", "exec \"$0\" -f /dev/null -o manager.shutdown_on_nortcs:NO <&-", TANDEM_RTM_HOST},
        {.output = pipe.writer(), .errors = pipe.writer()});
    pipe.close_writer();
    std::string text;
    for (int i = 0; i < 3000 && text.find("ready") == std::string::npos && pipe.read_available(text); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    INFO(text);
    CHECK(std::filesystem::read_symlink("/proc/" + std::to_string(host.pid()) + "/fd/0") == "/dev/null");
}
