// SPDX-License-Identifier: Apache-2.0
#include "apps/hosts/input_relay.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

namespace tandem::hosts {
namespace {

[[noreturn]] void fail(const char* what) {
    throw std::runtime_error(std::string("cannot create a ") + what +
                             " for a host's input: " + std::strerror(errno));
}

// Of the program that has the other end of a terminal.
bool is_echoing(int terminal) {
    termios settings{};
    return tcgetattr(terminal, &settings) == 0 && (settings.c_lflag & ECHO) != 0;
}

} // namespace

InputRelay::InputRelay(int source) : source_(source), terminal_(UserTerminal::open(source)) {
    std::signal(SIGTTIN, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN); // a receiver may end
    if (terminal_) source_ = terminal_->descriptor();
}

InputRelay::Input InputRelay::add_receiver() {
    if (terminal_) return add_terminal();
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) fail("pipe");
    process::FileDescriptor reader(ends[0]), writer(ends[1]);
    fcntl(writer.get(), F_SETFL, O_NONBLOCK);
    if (source_ >= 0) receivers_.push_back({std::move(writer)});
    return {std::move(reader)};
}

InputRelay::Input InputRelay::add_terminal() {
    process::FileDescriptor ours(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC));
    std::array<char, 64> name{};
    if (!ours || unlockpt(ours.get()) != 0 || ptsname_r(ours.get(), name.data(), name.size()) != 0)
        fail("terminal");
    process::FileDescriptor hosts(open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC));
    if (!hosts) fail("terminal");
    tcsetattr(hosts.get(), TCSANOW, &terminal_->settings());
    const winsize size = terminal_->size();
    ioctl(hosts.get(), TIOCSWINSZ, &size);
    fcntl(ours.get(), F_SETFL, O_NONBLOCK);
    if (source_ >= 0) receivers_.push_back({std::move(ours)});
    return {std::move(hosts), name.data()};
}

void InputRelay::add_events(std::vector<pollfd>& events) {
    if (source_ < 0) return;
    if (!terminal_) return events.push_back({source_, POLLIN, 0});
    if (terminal_->in_foreground()) events.push_back({source_, POLLIN, 0});
    for (const auto& receiver : receivers_)
        if (!receiver.is_closed) events.push_back({receiver.descriptor.get(), POLLIN, 0});
}

void InputRelay::forward() {
    if (source_ < 0) return;
    if (terminal_) update_terminals();
    pollfd event{source_, POLLIN, 0};
    if ((terminal_ && !terminal_->in_foreground()) || poll(&event, 1, 0) <= 0) return;
    std::array<char, 4096> text{};
    const auto size = read(source_, text.data(), text.size());
    if (size > 0)
        send(text.data(), static_cast<std::size_t>(size));
    else if (size == 0 || (errno != EINTR && errno != EAGAIN))
        end();
}

// Several children may echo a key. It is shown once, and not at all while one of them reads keys without an echo. Output that
// such a child writes to its terminal is not an echo. A child that has closed its terminal is still the leader of its session:
// if this end were closed too, the kernel would end the child with SIGHUP.
void InputRelay::update_terminals() {
    const winsize size = terminal_->size();
    const bool all_echo = std::all_of(receivers_.begin(), receivers_.end(), [](const Receiver& receiver) {
        return receiver.is_closed || is_echoing(receiver.descriptor.get());
    });
    bool is_first = true;
    for (Receiver& receiver : receivers_) {
        const int terminal = receiver.descriptor.get();
        ioctl(terminal, TIOCSWINSZ, &size);
        std::array<char, 4096> text{};
        const auto length = read(terminal, text.data(), text.size());
        receiver.is_closed = length < 0 && errno == EIO;
        if (receiver.is_closed) continue;
        const bool is_shown = all_echo ? is_first : !is_echoing(terminal);
        is_first = false; // also without text now: its echo comes later than that of another
        if (length > 0 && is_shown) terminal_->show({text.data(), static_cast<std::size_t>(length)});
    }
    std::erase_if(receivers_, [](const Receiver& receiver) {
        return receiver.is_closed && tcgetsid(receiver.descriptor.get()) < 0; // the child has ended
    });
}

void InputRelay::send(const char* text, std::size_t size) {
    std::erase_if(receivers_, [&](const Receiver& receiver) {
        return write(receiver.descriptor.get(), text, size) < 0 && errno == EPIPE;
    });
}

void InputRelay::release_terminal() {
    if (terminal_) terminal_->release();
}

void InputRelay::end() {
    source_ = -1;
    receivers_.clear();
}

} // namespace tandem::hosts
