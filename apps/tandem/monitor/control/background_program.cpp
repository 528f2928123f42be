// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/control/background_program.hpp"

#include <fcntl.h>

#include <algorithm>

namespace tandem::monitor {
namespace {

process::ChildProcess start(const std::vector<std::string>& command, int output) {
    const process::FileDescriptor nothing(open("/dev/null", O_RDONLY | O_CLOEXEC));
    process::ChildOptions options;
    options.input = nothing.get();
    options.output = options.errors = output;
    return process::ChildProcess(command, options);
}

std::uint64_t now_ms() {
    const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
    return static_cast<std::uint64_t>(
        std::chrono::duration_cast<std::chrono::milliseconds>(since_epoch).count());
}

} // namespace

BackgroundProgram::BackgroundProgram(const std::vector<std::string>& command, int output)
    : child_(start(command, output)), since_ms_(now_ms()) {}

BackgroundProgram::~BackgroundProgram() {
    stop();
    if (!stopped_) return; // has ended by itself
    const auto left = *stopped_ + max_end - std::chrono::steady_clock::now();
    child_.wait(std::max(std::chrono::ceil<std::chrono::milliseconds>(left), std::chrono::milliseconds(0)));
}

void BackgroundProgram::stop() {
    if (look() || stopped_) return;
    stopped_ = std::chrono::steady_clock::now();
    child_.terminate();
}

const std::optional<process::ExitStatus>& BackgroundProgram::look() {
    if (stopped_ && std::chrono::steady_clock::now() > *stopped_ + max_end) return child_.kill();
    return child_.poll();
}

} // namespace tandem::monitor
