// SPDX-License-Identifier: Apache-2.0
#include "host/plugin/probe_child.hpp"

#include "host/plugin/probe_protocol.hpp"
#include "host/process/child_process.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <string_view>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

namespace tandem::plugin {
namespace {

// Unbuffered, because the library's next code may end the process.
void write_report(std::string_view text) {
    while (!text.empty()) {
        const ssize_t sent = write(process::report_descriptor, text.data(), text.size());
        if (sent < 0 && errno == EINTR) continue;
        if (sent <= 0) _exit(1); // the parent has closed its end of the pipe
        text.remove_prefix(static_cast<std::size_t>(sent));
    }
}

// The protocol consists of lines.
std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

[[noreturn]] void run(const ProbeTasks& tasks, int argc, char** argv) {
    try {
        ProbeReport report;
        tasks.at(argv[2])({argv[3], {argv + 4, argv + argc}}, report);
    } catch (const std::exception& error) {
        write_report(failed_tag + one_line(error.what()) + "\n");
        _exit(1);
    }
    write_report(done_line);
    _exit(0); // not exit(): the library is already unloaded, and exit handlers of this program are not tested
}

} // namespace

void ProbeReport::begin_stage(const std::string& function) {
    write_report(stage_tag + one_line(function) + "\n");
}

void ProbeReport::finish(const std::string& result) {
    write_report(result_tag + std::to_string(result.size()) + "\n" + result + done_line);
    _exit(0);
}

void serve_probe(int argc, char** argv, const ProbeTasks& tasks) {
    if (argc < 4 || std::strcmp(argv[1], probe_argument) != 0) return;
    prctl(PR_SET_PDEATHSIG, SIGKILL); // sent when the waiting thread of the parent ends
    const rlimit none{0, 0};
    setrlimit(RLIMIT_CORE, &none); // a crash is an expected result and needs no core file
    run(tasks, argc, argv);
}

} // namespace tandem::plugin
