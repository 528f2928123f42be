// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/census/host_watch.hpp"

#include "apps/tandem/monitor/host_files/process_files.hpp"
#include "host/process/published/component_states.hpp"
#include "host/rt/tick_page.hpp"
#include "shm/os/clock.hpp"

#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <unistd.h>
#include <utility>

namespace tandem::command {
namespace {

using Clock = std::chrono::steady_clock;
using process::ComponentState;
using namespace std::chrono_literals;

constexpr auto start_limit = 30s; // the host's own limits are shorter
constexpr auto stop_limit = 5s;
constexpr auto longest_delay = 3s;                        // of a cycle on a loaded machine
constexpr std::size_t max_output = std::size_t{32} << 20; // bytes
constexpr const char* marks[] = {"crashed in", "[critical]", "[error]",
                                 "error"}; // in the order of their weight

/// The states and ticks that a process publishes.
struct Published {
    bool active = false, error = false;
    std::uint64_t ticks = 0;
    bool has_ticks = false;
    bool waits = false;   ///< for the time of a tick
    std::string callback; ///< in which a tick is
};

template <class File>
std::vector<std::unique_ptr<const File>> read_files(pid_t pid) {
    std::vector<std::unique_ptr<const File>> found;
    for (const auto& file :
         monitor::open_memory_files(static_cast<std::uint32_t>(pid), File::file_name, sizeof(File)))
        if (auto copy = monitor::read_memory_file<File>(file)) found.push_back(std::move(copy));
    return found;
}

Published read_published(pid_t pid) {
    Published read;
    for (const auto& file : read_files<process::ComponentStates>(pid))
        for (const auto& place : file->place) {
            read.active |= place.state == static_cast<std::uint64_t>(ComponentState::active);
            read.error |= place.state == static_cast<std::uint64_t>(ComponentState::error);
        }
    for (const auto& page : read_files<rt::TickPage>(pid))
        for (const auto& slot : page->slot) {
            if (slot.period_ns == 0) continue;
            read.has_ticks = true;
            read.ticks += slot.ticks;
            if (const auto callback = monitor::printable_text(slot.callback.callback); !callback.empty())
                read.callback = callback;
            else
                read.waits |= slot.due_ns > static_cast<std::int64_t>(shm::now_ns());
        }
    return read;
}

// Returns the line without the time, the level and the name of the host, which a log line begins with.
std::string message_of(std::string line) {
    while (line.starts_with('[') && line.find("] ") != std::string::npos) line.erase(0, line.find("] ") + 2);
    for (const std::string host : {"opros_host: ", "rtm_host: "})
        if (line.starts_with(host)) line.erase(0, host.size());
    return line;
}

bool is_log_line(const std::string& line) {
    return line.find("] opros_host: ") != std::string::npos || line.find("] rtm_host: ") != std::string::npos;
}

/// Keeps the line of a host's output that says most about a failure.
class FirstError {
  public:
    void add(const std::string& line) {
        bytes_ += line.size() + 1;
        if (line.find_first_not_of(" \t") == std::string::npos) return;
        const auto before = last_; // a line that the component has printed
        if (!is_log_line(line)) last_ = line;
        if (best_ == std::size(marks)) text_ = message_of(line);
        for (std::size_t mark = 0; mark < best_; ++mark)
            if (line.find(marks[mark]) != std::string::npos) {
                best_ = mark;
                text_ = message_of(line) + (before.empty() ? "" : " (line before: " + before + ")");
            }
    }
    const std::string& text() const { return text_; }
    bool is_marked() const { return best_ < std::size(marks); }
    std::size_t bytes() const { return bytes_; }

  private:
    std::size_t bytes_ = 0, best_ = std::size(marks); ///< the mark in the line
    std::string text_, last_;
};

/// One host from start to end.
class HostWatch {
  public:
    HostWatch(hosts::Supervisor& supervisor, const hosts::HostCommand& command)
        : supervisor_(supervisor), host_(supervisor.start(command)) {}

    HostRecord run(std::chrono::duration<double> seconds) {
        wait([&] { return host_.ready(); }, start_limit);
        if (failed()) return end();
        if (!host_.ready()) {
            record_.error = fmt::format("does not start within {} s{}", start_limit.count(), where(now_));
            return end();
        }
        wait([] { return false; }, seconds / 2);
        const auto before = now_;
        wait([] { return false; }, seconds / 2);
        wait([&] { return now_.error || runs_since(before); }, longest_delay);
        if (!failed()) judge(before);
        return end();
    }

  private:
    template <class Done>
    void wait(const Done& done, std::chrono::duration<double> limit) {
        const auto end = Clock::now() + limit;
        while (!failed() && !done() && Clock::now() < end) {
            const auto events = supervisor_.watch(100ms);
            record_.interrupted |= events.interrupted;
            for (const auto& [host, line] : events.lines) first_error_.add(line);
            if (host_.running()) now_ = read_published(host_.process.pid());
            record_.cycles = std::max(record_.cycles, now_.ticks);
        }
    }

    // Sets the error if the host ended or prints too much.
    bool failed() {
        if (record_.interrupted) return true;
        if (!host_.running() && record_.error.empty())
            record_.error = first_error_.is_marked()
                                ? first_error_.text()
                                : fmt::format("its host {}{}", host_.process.poll()->text(), last_words());
        if (first_error_.bytes() > max_output)
            record_.error = fmt::format("prints more than {} MiB", max_output >> 20);
        return !record_.error.empty();
    }

    static std::string where(const Published& published) {
        return published.callback.empty() ? "" : ": it is in " + published.callback;
    }

    std::string last_words() const { return first_error_.text().empty() ? "" : ": " + first_error_.text(); }

    // A component without ticks runs if it is active. A period may be longer than the time since `before`.
    bool runs_since(const Published& before) const {
        return now_.active && (!now_.has_ticks || now_.waits || now_.ticks != before.ticks);
    }

    void judge(const Published& before) {
        if (now_.error)
            record_.error = "goes to its error state" + last_words();
        else if (!now_.active)
            record_.error = "does not become active" + where(now_);
        else if (!runs_since(before))
            record_.error = "hangs" + where(now_);
        else
            record_.runs = true;
    }

    HostRecord end() {
        const bool was_running = host_.running();
        const bool in_order = supervisor_.stop_all(stop_limit, [this](const auto& events) {
            record_.interrupted |= events.interrupted;
            for (const auto& [host, line] : events.lines) first_error_.add(line);
        });
        if (was_running && !in_order && record_.runs) {
            record_.runs = false;
            const auto& ended = host_.process.poll();
            record_.error =
                ended && (!ended->signalled || ended->code != SIGKILL)
                    ? fmt::format("runs, but its host {} at its end{}", ended->text(), last_words())
                    : fmt::format("runs, but does not end within {} s of SIGTERM", stop_limit.count());
        }
        return record_;
    }

    hosts::Supervisor& supervisor_;
    hosts::Host& host_;
    FirstError first_error_;
    Published now_;
    HostRecord record_;
};

} // namespace

HostRecord watch_host(hosts::Supervisor& supervisor, const std::vector<std::string>& command,
                      const std::string& folder, double seconds) {
    auto record = HostWatch(supervisor, {command.front(), command, "", folder})
                      .run(std::chrono::duration<double>(seconds));
    supervisor.hosts().pop_back(); // it has ended; a census of many would use up the descriptors
    return record;
}

} // namespace tandem::command
