// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/control/programs.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <system_error>

namespace tandem::monitor {
namespace {

constexpr std::chrono::milliseconds look_pause{20};

/// Returns the start of a program's output. Replaces all but newlines and printable ASCII by '?'.
std::string text_in(int file) {
    std::string text(Programs::max_output, '\0');
    const auto bytes = pread(file, text.data(), text.size(), 0);
    text.resize(bytes < 0 ? 0 : static_cast<std::size_t>(bytes));
    for (char& c : text)
        if (c != '\n' && (c < ' ' || c > '~')) c = '?';
    return text;
}

} // namespace

void Programs::run(const std::vector<std::string>& command, Done done) {
    if (jobs_.size() >= max_running) return done(false, "four commands are already running; try again");
    process::FileDescriptor output(memfd_create("tandem-command", MFD_CLOEXEC));
    process::ChildOptions options;
    options.output = options.errors = output.get();
    try {
        jobs_.push_back({process::ChildProcess(command, options), std::move(output),
                         std::chrono::steady_clock::now() + max_time, std::move(done)});
    } catch (const std::system_error& error) {
        return done(false, error.what());
    }
    if (jobs_.size() == 1) look();
}

void Programs::look() {
    for (auto job = jobs_.begin(); job != jobs_.end();) {
        const bool late = std::chrono::steady_clock::now() > job->end;
        if (late) job->child.kill();
        const auto ended = job->child.poll();
        if (!ended && !late) {
            ++job;
            continue;
        }
        const std::string output =
            text_in(job->output.get()) + (late ? "stopped: it took more than 15 s\n" : "");
        const Done done = std::move(job->done);
        job = jobs_.erase(job);
        done(ended && ended->success(), output);
    }
    if (jobs_.empty()) return;
    timer_.expires_after(look_pause);
    timer_.async_wait([this](const boost::system::error_code& aborted) {
        if (!aborted) look();
    });
}

} // namespace tandem::monitor
