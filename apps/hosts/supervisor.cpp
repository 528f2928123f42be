// SPDX-License-Identifier: Apache-2.0
#include "apps/hosts/supervisor.hpp"

#include "host/process/output_file.hpp"
#include "host/text/quote.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <initializer_list>
#include <utility>

namespace tandem::hosts {

namespace {

using namespace std::chrono_literals;
constexpr auto stop_grace = 5s;
// A request to end may arrive as several signals: timeout(1) sends one to the process and one to its group.
constexpr double one_request_s = 1.0;
// A host that ends within this time after its start counts as failed at once.
constexpr double long_enough_s = 10.0;
constexpr auto first_restart_delay = 100ms, max_restart_delay = 10'000ms;

sigset_t set_of(std::initializer_list<int> signals) {
    sigset_t set;
    sigemptyset(&set);
    for (int each : signals) sigaddset(&set, each);
    return set;
}

sigset_t handled_signals() { return set_of({SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP}); }

// Uses the signal's own action, which the kernel omits if no shell could continue this program.
void stop_this_program() {
    const auto set = set_of({SIGTSTP});
    raise(SIGTSTP);
    sigprocmask(SIG_UNBLOCK, &set, nullptr); // returns when the user continues this program
    sigprocmask(SIG_BLOCK, &set, nullptr);
}

/// A process and the pipe from its standard output.
struct Started {
    process::ChildProcess process;
    process::OutputPipe output;
};

// Returns 0 if the file does not exist.
std::streamoff size_of(const std::string& path) {
    std::ifstream file(path, std::ios::ate);
    return file ? static_cast<std::streamoff>(file.tellg()) : 0;
}

double monotonic_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Started start_process(const HostCommand& host, std::optional<InputRelay>& relay) {
    process::OutputPipe output;
    InputRelay::Input input;
    if (relay) input = relay->add_receiver();
    process::FileDescriptor log;
    if (!host.log.empty()) log = process::open_output(host.log, process::Existing::append, 0600);
    setenv("TANDEM_SUPERVISED", "1", 1); // see write_ready_line()
    process::ChildOptions options;
    if (input.terminal.empty()) options.input = input.descriptor.get();
    options.terminal = input.terminal;
    options.output = output.writer();
    options.errors = log ? log.get() : output.writer();
    options.folder = host.folder;
    process::ChildProcess child(host.command, options);
    output.close_writer();
    return {std::move(child), std::move(output)};
}

} // namespace

std::string Host::command_line() const {
    std::vector<std::string> words;
    for (const auto& word : command)
        if (word != "--parent-death")
            words.push_back(text::quote_shell(word)); // the user's shell may end before the host
    return fmt::format("{}", fmt::join(words, " "));
}

std::string Host::first_error() const {
    if (log.empty()) return last_line;
    std::ifstream file(log);
    file.seekg(log_start);
    std::string last;
    for (std::string line; std::getline(file, line);) {
        if (line.find("error") != line.npos) return line;
        if (!line.empty()) last = line;
    }
    return last;
}

Supervisor::Supervisor() {
    // Must run before any thread or child exists. ChildProcess gives its children an empty signal mask.
    const auto set = handled_signals();
    sigprocmask(SIG_BLOCK, &set, nullptr);
    signals_ = process::FileDescriptor(signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK));
}

Supervisor::~Supervisor() {
    for (auto host = hosts_.rbegin(); host != hosts_.rend(); ++host) stop(*host);
    const auto set = handled_signals();
    sigprocmask(SIG_UNBLOCK, &set, nullptr);
}

Host& Supervisor::start(const HostCommand& command) {
    const auto log_start = size_of(command.log);
    auto started = start_process(command, input_);
    hosts_.push_back(Host{command, log_start, std::move(started.process), std::move(started.output)});
    hosts_.back().started_at = monotonic_seconds();
    return hosts_.back();
}

std::chrono::milliseconds Supervisor::restart(Host& host) {
    const double now = monotonic_seconds();
    host.quick_ends = now - host.started_at < long_enough_s ? host.quick_ends + 1 : 0;
    host.was_ready = host.ready();
    host.ready_at = 0.0;
    const auto delay = restart_delay(host);
    host.restart_at = now + std::chrono::duration<double>(delay).count();
    return delay;
}

std::chrono::milliseconds Supervisor::restart_delay(const Host& host) {
    auto delay = 0ms;
    for (int end = 2; end <= host.quick_ends && delay < max_restart_delay; ++end)
        delay = std::min(delay == 0ms ? first_restart_delay : 2 * delay, max_restart_delay);
    return delay;
}

void Supervisor::restart_due(Events& found) {
    const double now = monotonic_seconds();
    for (Host& host : hosts_) {
        if (!host.waits_for_restart() || now < host.restart_at) continue;
        try {
            start_again(host);
            found.restarted.push_back(&host);
        } catch (
            const std::runtime_error& error) { // a limit of processes or a full disk must not end the others
            ++host.quick_ends;
            const auto delay = std::max(restart_delay(host), std::chrono::milliseconds(first_restart_delay));
            host.restart_at = now + std::chrono::duration<double>(delay).count();
            found.failed_restarts.emplace_back(&host, error.what());
        }
    }
}

void Supervisor::start_again(Host& host) {
    host.restart_at = 0.0;
    host.log_start = size_of(host.log);
    HostCommand again = host;
    if (host.was_ready)
        again.command.insert(again.command.end(), host.restart_arguments.begin(),
                             host.restart_arguments.end());
    auto started = start_process(again, input_);
    host.process = std::move(started.process);
    host.output = std::move(started.output);
    host.unread.clear();
    host.last_line.clear();
    host.blank_lines = 0;
    host.ready_at = 0.0;
    host.ready_line.clear();
    host.started_at = monotonic_seconds();
    host.ended = false;
}

/// Adds `host.last_line` after the blank lines before it.
void Supervisor::add_line(Host& host, Events& found) {
    // `ready, but ...` comes from a host that lacks components.
    const bool becomes_ready = host.last_line.rfind("ready", 0) == 0 && !host.ready();
    if (host.last_line.empty() && !host.ready()) {
        ++host.blank_lines;
        return;
    }
    if (becomes_ready) {
        host.ready_at = monotonic_seconds();
        host.ready_line = host.last_line;
        found.became_ready.push_back(&host);
        --host.blank_lines; // the one that `ready` adds
    }
    for (; host.blank_lines > 0; --host.blank_lines)
        if (host.log.empty()) found.lines.emplace_back(&host, "");
    host.blank_lines = 0;
    if (host.log.empty()) found.lines.emplace_back(&host, host.last_line);
}

void Supervisor::read_output(Host& host, Events& found) {
    constexpr std::size_t max_line = 4096;
    constexpr double prompt_s = 0.2; // text that waits this long without a newline is a prompt
    const std::size_t before = host.unread.size();
    host.output.read_available(host.unread);
    if (host.unread.size() != before) host.unread_since = monotonic_seconds();
    std::size_t begin = 0; // erasing each line separately would take long if a component prints without pause
    for (std::size_t end; (end = host.unread.find('\n', begin)) != host.unread.npos; begin = end + 1) {
        host.last_line = host.unread.substr(begin, end - begin);
        add_line(host, found);
    }
    host.unread.erase(0, begin);
    const bool is_prompt = host.log.empty() && !host.unread.empty() && host.unread.size() == before &&
                           monotonic_seconds() > host.unread_since + prompt_s;
    if (host.unread.size() <= max_line && !is_prompt) return;
    // Passes an incomplete or too long line on in parts. Such a line cannot end with "ready".
    if (host.log.empty()) found.lines.emplace_back(&host, host.unread);
    host.unread.clear();
}

Supervisor::Events Supervisor::watch(std::chrono::milliseconds timeout) {
    // With a log, reads a host's output only until it is ready, because hosts write nothing to it afterwards.
    std::vector<pollfd> events{{signals_.get(), POLLIN, 0}};
    for (Host& host : hosts_) {
        if (!host.running()) continue;
        events.push_back({host.process.pidfd(), POLLIN, 0});
        if (!host.ready() || host.log.empty()) events.push_back({host.output.reader(), POLLIN, 0});
    }
    if (input_) input_->add_events(events);
    for (const Host& host : hosts_)
        if (host.waits_for_restart())
            timeout = std::min(timeout, std::chrono::milliseconds(static_cast<long>(std::ceil(
                                            1000 * std::max(0.0, host.restart_at - monotonic_seconds())))));
    poll(events.data(), events.size(), static_cast<int>(timeout.count()));
    Events found;
    restart_due(found);
    if (input_) input_->forward();
    found.interrupted = read_signals();
    for (Host& host : hosts_) {
        if (!host.running()) continue;
        const bool ended =
            host.process.poll().has_value(); // checked first, so that nothing is written after the last read
        read_output(host, found);
        if (!ended) continue;
        if (!host.unread.empty()) { // a last line without a newline
            host.last_line = std::exchange(host.unread, "");
            if (host.log.empty()) found.lines.emplace_back(&host, host.last_line);
        }
        host.ended = true;
        found.ended.push_back(&host);
    }
    return found;
}

bool Supervisor::read_signals() {
    bool interrupted = false;
    signalfd_siginfo info{};
    while (read(signals_.get(), &info, sizeof info) == sizeof info) {
        if (info.ssi_signo != SIGTSTP) {
            interrupted = true;
            continue;
        }
        if (input_) input_->release_terminal();
        stop_this_program();
    }
    return interrupted;
}

void Supervisor::wait_until_ready(double seconds) {
    const double end = monotonic_seconds() + seconds;
    for (;;) {
        const Host* missing = nullptr;
        for (const Host& host : hosts_)
            if (!host.ready()) missing = &host;
        if (!missing) return;
        if (monotonic_seconds() > end)
            throw std::runtime_error(
                fmt::format("{} (pid {}) was not ready within {:g} s{}{}; allow more time with --host-wait",
                            missing->name, missing->process.pid(), seconds,
                            missing->first_error().empty() ? "" : "; its log: ", missing->first_error()));
        const auto found = watch(50ms);
        if (found.interrupted) throw Interrupted();
        for (Host* host : found.ended)
            throw std::runtime_error(fmt::format("{} (pid {}) {} before it was ready: {}", host->name,
                                                 host->process.pid(), host->process.poll()->text(),
                                                 host->first_error()));
    }
}

bool Supervisor::stop(Host& host) {
    host.restart_at = 0.0;
    if (!host.running()) return false;
    const auto& ended = host.process.stop(stop_grace);
    host.ended = true;
    return ended && !ended->signalled && ended->code == 0;
}

bool Supervisor::stop_all(std::chrono::milliseconds grace, const std::function<void(const Events&)>& handle) {
    const double begin = monotonic_seconds();
    const double end = begin + std::chrono::duration<double>(grace).count();
    bool killed = false;
    for (Host& host : hosts_) {
        host.restart_at = 0.0;
        if (host.running()) host.process.terminate();
    }
    if (input_) input_->end(); // a component that waits for a key would hold up its host
    const auto is_running = [](const Host& host) { return host.running(); };
    while (std::any_of(hosts_.begin(), hosts_.end(), is_running)) {
        const auto events = watch(50ms);
        handle(events);
        const double now = monotonic_seconds();
        if (!killed && (now > end || (events.interrupted && now > begin + one_request_s))) {
            killed = true;
            for (Host& host : hosts_)
                if (host.running()) host.process.kill();
        }
    }
    return std::all_of(hosts_.begin(), hosts_.end(),
                       [](Host& host) { return host.process.poll()->success(); });
}

} // namespace tandem::hosts
