// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/samples/sample_feed.hpp"

#include "apps/tandem/monitor/newest_value.hpp"
#include "apps/tandem/observe/json_message.hpp"
#include "apps/tandem/observe/message_json.hpp"
#include "apps/tandem/record/cdr_message.hpp"
#include "proxy/wire/time.hpp"
#include "shm/os/clock.hpp"
#include "shm/os/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

namespace tandem::monitor {
namespace {

/// 25 times a second. A look takes a quarter of the time between two at most, so that the monitor keeps serving pages.
constexpr std::chrono::milliseconds look_pause{40};
constexpr RoundBounds look_bounds{std::size_t{8} << 20, 10'000'000};
/// A time further away from that of reading is not of the same clock.
constexpr double believable_ms = 2000;

double to_ms(std::uint64_t ns) { return static_cast<double>(ns) / 1e6; }

/// An any brings its own type, and a list of elements without bytes may be as long as its sender says.
bool is_plotted(const wire::Type& message) {
    return std::all_of(message.children.begin(), message.children.end(), command::takes_bytes);
}

std::string chunk_head(const SamplePort& port, const std::vector<std::string>& names) {
    const nlohmann::json head{
        {"link", port.link}, {"owner", name_of(port.owner)}, {"port", port.name}, {"names", names}};
    std::string text = head.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    text.pop_back(); // the object continues with its samples
    return text + R"(,"samples":[)";
}

/// Returns `[number, time, value ...]`; null stands for a value that is not finite.
std::string row(std::uint64_t sequence, double time_ms, const std::vector<double>& values) {
    std::string text = fmt::format("[{},{:.3f}", sequence, time_ms);
    for (const double value : values) text += std::isfinite(value) ? fmt::format(",{}", value) : ",null";
    return text + "]";
}

} // namespace

SampleClock::SampleClock() : monotonic_offset_ms_(to_ms(command::wall_clock_ns()) - to_ms(shm::now_ns())) {}

/// The sender's clock may be that of this machine, its monotonic clock, or another one that runs as fast; the first
/// message tells how far that one is off. Without a useful stamp, the time of reading counts.
double SampleClock::time_of(std::uint64_t stamp) {
    const double wall_ms = to_ms(command::wall_clock_ns());
    const double sent_ms = 1e3 * wire::stamp_seconds(stamp) + wire::stamp_nanoseconds(stamp) / 1e6;
    const auto is_near = [&](double offset_ms) {
        return std::abs(sent_ms + offset_ms - wall_ms) < believable_ms;
    };
    double time = wall_ms;
    if (sent_ms > last_sent_ms_) {
        for (const double offset_ms : {0.0, monotonic_offset_ms_, offset_ms_})
            if (is_near(offset_ms)) {
                time = sent_ms + offset_ms;
                break;
            }
        if (time == wall_ms) offset_ms_ = wall_ms - sent_ms;
    }
    last_sent_ms_ = sent_ms;
    return last_ = std::max(time, last_ + 0.001);
}

void SampleFeed::add(SampleClient& client) {
    clients_.insert(&client);
    if (!looks_) look();
}

/// Only ports of links that the monitor shows.
void SampleFeed::update_ports() {
    std::set<std::string> shown;
    for (const LinkState& link : state_().links)
        if (link.readable) shown.insert(link.name);
    std::set<SamplePort> wanted;
    for (const SampleClient* client : clients_)
        for (const SamplePort& port : client->ports())
            if (shown.count(port.link) != 0) wanted.insert(port);
    std::erase_if(followed_, [&](const auto& followed) { return wanted.count(followed.first) == 0; });
    for (const SamplePort& port : wanted)
        if (followed_.size() < max_ports) followed_.try_emplace(port, port);
}

/// Each look begins with another port, so that none keeps the others from being read.
void SampleFeed::read_ports() {
    auto begin = followed_.upper_bound(first_);
    if (begin == followed_.end()) begin = followed_.begin();
    if (begin == followed_.end()) return;
    first_ = begin->first;
    Round round(stop_, look_bounds);
    for (auto it = begin; it != followed_.end(); ++it) poll(it->first, it->second, round);
    for (auto it = followed_.begin(); it != begin; ++it) poll(it->first, it->second, round);
}

void SampleFeed::look() {
    looks_ = !clients_.empty();
    update_ports();
    if (!looks_) return;
    read_ports();
    const auto clients = clients_; // a copy, because a client may leave meanwhile
    const std::uint64_t now_ms = command::wall_clock_ns() / 1'000'000;
    for (SampleClient* client : clients) {
        if (clients_.count(client) == 0) continue;
        std::string json;
        for (const SamplePort& port : client->ports())
            if (const auto found = followed_.find(port);
                found != followed_.end() && !found->second.chunks.empty())
                json += (json.empty() ? "" : ",") + found->second.chunks + "]}";
        if (!json.empty()) client->samples(now_ms, json);
    }
    for (auto& [port, followed] : followed_) followed.chunks.clear();
    timer_.expires_after(look_pause);
    timer_.async_wait([this](const boost::system::error_code& aborted) {
        if (!aborted) look();
    });
}

void SampleFeed::poll(const SamplePort& port, Followed& followed, Round& round) {
    if (round.bytes_left() == 0) return;
    try {
        followed.follower.poll(
            [&](const command::LinkFollower::Port& of, const shm::FollowedRecord& record) {
                round.count_message(record.bytes.size());
                if (of.owner == port.owner) add_sample(port, followed, of, record);
            },
            {}, command::LinkFollower::Rings::likely, [&] { return round.bytes_left(); });
    } catch (const shm::Error&) { // the link was removed meanwhile
    }
}

void SampleFeed::add_sample(const SamplePort& port, Followed& followed, const command::FollowedPort& of,
                            const shm::FollowedRecord& record) {
    if (record.bytes.size() > NewestValue::max_message || !is_plotted(of.message)) return;
    try {
        const auto [names, values] = numbers_of(command::message_to_json(of, record.bytes, record.stamp));
        const bool begins = followed.chunks.empty() || names != followed.names;
        if (begins) followed.chunks += (followed.chunks.empty() ? "" : "]},") + chunk_head(port, names);
        followed.names = names;
        followed.chunks +=
            (begins ? "" : ",") + row(record.sequence, followed.clock.time_of(record.stamp), values);
    } catch (const std::runtime_error&) { // untrusted bytes of another process: the state says so
    }
}

} // namespace tandem::monitor
