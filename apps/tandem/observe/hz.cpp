// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/observe/commands.hpp"
#include "apps/tandem/observe/open_link.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/table.hpp"
#include "shm/os/clock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <thread>

namespace tandem::command {
namespace {

/// Polling interval of a port, and so the accuracy of an interval.
constexpr std::chrono::microseconds look_interval{200};

/// The intervals between the messages of a port in one period, in ms, by Welford's method (Technometrics 4(3), 1962).
struct Intervals {
    std::uint64_t messages = 0, bytes = 0, last_ns = 0;
    std::uint64_t intervals = 0;
    double mean = 0, sum_of_squares = 0, min = 0, max = 0;

    void add(std::uint64_t now_ns, std::size_t length) {
        ++messages;
        bytes += length;
        if (last_ns != 0) add_interval(static_cast<double>(now_ns - last_ns) / 1e6);
        last_ns = now_ns;
    }
    double standard_deviation() const {
        return intervals < 2 ? 0 : std::sqrt(sum_of_squares / static_cast<double>(intervals - 1));
    }
    /// Starts the next period. Keeps the last message, because the next interval begins with it.
    void restart() {
        const std::uint64_t last = last_ns;
        *this = Intervals{};
        last_ns = last;
    }

  private:
    void add_interval(double ms) {
        ++intervals;
        min = intervals == 1 ? ms : std::min(min, ms);
        max = std::max(max, ms);
        const double difference = ms - mean;
        mean += difference / static_cast<double>(intervals);
        sum_of_squares += difference * (ms - mean);
    }
};

using PortIntervals = std::map<std::string, Intervals>;

std::string format_intervals(const PortIntervals& ports, double seconds) {
    Table table({"port", ">messages/s", ">kB/s", ">interval ms", ">min", ">max", ">std.dev."});
    for (const auto& [name, port] : ports) {
        const auto ms = [&port = port](double value) {
            return port.intervals == 0 ? "-" : fmt::format("{:.2f}", value);
        };
        table.add_row({replace_nonprintable(name),
                       fmt::format("{:.1f}", static_cast<double>(port.messages) / seconds),
                       fmt::format("{:.1f}", static_cast<double>(port.bytes) / seconds / 1e3), ms(port.mean),
                       ms(port.min), ms(port.max), ms(port.standard_deviation())});
    }
    return table.text();
}

nlohmann::json intervals_json(const PortIntervals& ports, double seconds) {
    auto list = nlohmann::json::array();
    for (const auto& [name, port] : ports)
        list.push_back({{"port", name},
                        {"messages_per_s", static_cast<double>(port.messages) / seconds},
                        {"bytes_per_s", static_cast<double>(port.bytes) / seconds},
                        {"intervals", port.intervals},
                        {"mean_ms", port.mean},
                        {"min_ms", port.min},
                        {"max_ms", port.max},
                        {"standard_deviation_ms", port.standard_deviation()}});
    return {{"seconds", seconds}, {"ports", list}};
}

} // namespace

int hz(const HzOptions& options) {
    LinkFollower follower = open_link(options.link, options.ports);
    PortIntervals ports;
    const auto period_ns = static_cast<std::uint64_t>(options.period_s * 1e9);
    std::uint64_t begin_ns = shm::now_ns();
    for (std::uint64_t tables = 0; options.count == 0 || tables < options.count;) {
        for (const auto& port : follower.ports()) ports.try_emplace(port.port.name);
        follower.poll([&](const LinkFollower::Port& port, const shm::FollowedRecord& record) {
            ports[port.port.name].add(shm::now_ns(), record.bytes.size());
        });
        std::this_thread::sleep_for(look_interval);
        const std::uint64_t now = shm::now_ns();
        if (now - begin_ns < period_ns) continue;
        const double seconds = static_cast<double>(now - begin_ns) / 1e9;
        if (options.json)
            print_json(intervals_json(ports, seconds), true);
        else
            print_text(format_intervals(ports, seconds) + "\n");
        for (auto& [name, port] : ports) port.restart();
        begin_ns = now;
        ++tables;
    }
    return 0;
}

} // namespace tandem::command
