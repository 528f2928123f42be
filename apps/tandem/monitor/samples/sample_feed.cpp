// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/samples/sample_feed.hpp"

#include "apps/tandem/monitor/newest_value.hpp"
#include "apps/tandem/monitor/samples/message_numbers.hpp"
#include "apps/tandem/monitor/samples/picture.hpp"
#include "apps/tandem/observe/json_message.hpp"
#include "apps/tandem/observe/message_json.hpp"
#include "apps/tandem/record/cdr_message.hpp"
#include "shm/os/clock.hpp"
#include "shm/os/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace tandem::monitor {
namespace {

/// 25 times a second. A look takes a quarter of the time between two at most, so that the monitor keeps serving pages.
constexpr std::chrono::milliseconds poll_pause{40};
constexpr RoundBounds look_bounds{std::size_t{8} << 20, 10'000'000};
/// Between two messages of a port that are sent as a whole, for drawings.
constexpr std::uint64_t whole_pause_ns = 100'000'000;

/// An any brings its own type, and a list of elements without bytes may be as long as its sender says.
bool is_plotted(const wire::Type& message) {
    return std::all_of(message.children.begin(), message.children.end(), command::takes_bytes);
}

/// Returns the start of an object about a port, without the closing brace.
std::string port_head(const SamplePort& port, const nlohmann::ordered_json& members) {
    nlohmann::ordered_json head{{"link", port.link}, {"owner", name_of(port.owner)}, {"port", port.name}};
    head.update(members);
    std::string text = head.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    text.pop_back();
    return text;
}

std::string chunk_head(const SamplePort& port, const std::vector<std::string>& names) {
    return port_head(port, {{"names", names}}) + R"(,"samples":[)";
}

/// Returns the bytes of the header (uint32, little endian), the header as JSON, and the pixels.
std::string picture_frame(const SamplePort& port, const Picture& picture) {
    const std::string head =
        port_head(port, {{"width", picture.width}, {"height", picture.height}, {"format", picture.format}}) +
        "}";
    const auto size = static_cast<std::uint32_t>(head.size());
    std::string frame(sizeof size, '\0');
    std::memcpy(frame.data(), &size, sizeof size);
    frame += head;
    return frame.append(reinterpret_cast<const char*>(picture.pixels.data()), picture.pixels.size());
}

/// Returns `[number, time, value ...]`; null stands for a value that is not finite.
std::string row(std::uint64_t sequence, double time_ms, const std::vector<double>& values) {
    std::string text = fmt::format("[{},{:.3f}", sequence, time_ms);
    for (const double value : values) text += std::isfinite(value) ? fmt::format(",{}", value) : ",null";
    return text + "]";
}

} // namespace

void SampleFeed::add(SampleClient& client) {
    clients_.insert(&client);
    if (!looks_) look();
}

/// Follows the ports that clients want, of links that the monitor shows. Those beyond max_ports go to left_out_.
void SampleFeed::update_followed() {
    std::set<std::string> shown;
    for (const LinkState& link : state_().links)
        if (link.readable) shown.insert(link.name);
    std::set<SamplePort> wanted;
    for (const SampleClient* client : clients_)
        for (const SamplePort& port : client->ports())
            if (shown.count(port.link) != 0) wanted.insert(port);
    std::erase_if(followed_, [&](const auto& followed) { return wanted.count(followed.first) == 0; });
    left_out_.clear();
    for (const SamplePort& port : wanted)
        if (followed_.size() < max_ports)
            followed_.try_emplace(port, port);
        else if (followed_.count(port) == 0)
            left_out_.insert(port);
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
    update_followed();
    if (!looks_) return;
    read_ports();
    const auto clients = clients_; // a copy, because a client may leave meanwhile
    const std::uint64_t now_ms = command::wall_clock_ns() / 1'000'000;
    for (SampleClient* client : clients)
        if (clients_.count(client) != 0) send_to(*client, now_ms);
    for (auto& [port, followed] : followed_) {
        followed.chunks.clear();
        followed.message = nullptr;
        followed.frame = nullptr;
    }
    timer_.expires_after(poll_pause);
    timer_.async_wait([this](const boost::system::error_code& aborted) {
        if (!aborted) look();
    });
}

/// Pictures come last, in any order: a client takes only the first of several large ones.
void SampleFeed::send_to(SampleClient& client, std::uint64_t now_ms) {
    std::string json;
    std::vector<std::shared_ptr<const std::string>> frames;
    std::set<SamplePort> left_out;
    for (const SamplePort& port : client.ports()) {
        if (left_out_.count(port) != 0) left_out.insert(port);
        const auto found = followed_.find(port);
        if (found == followed_.end()) continue;
        const Followed& followed = found->second;
        if (!followed.chunks.empty()) json += (json.empty() ? "" : ",") + followed.chunks + "]}";
        if (!followed.message.is_null()) json += "," + port_head(port, {{"message", followed.message}}) + "}";
        if (followed.frame != nullptr) frames.push_back(followed.frame);
    }
    client.left_out(left_out);
    if (!json.empty()) client.samples(now_ms, json);
    std::shuffle(frames.begin(), frames.end(), order_);
    for (const auto& frame : frames) client.picture(frame);
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
    const bool whole = shm::now_ns() - followed.whole_ns >= whole_pause_ns;
    if (is_picture(of.message)) {
        if (whole && record.bytes.size() <= max_picture) add_picture(port, followed, of, record);
        return;
    }
    if (record.bytes.size() > NewestValue::max_message || !is_plotted(of.message)) return;
    try {
        auto message = command::message_to_json(of, record.bytes, record.stamp);
        const auto [names, values] = numbers_of(message);
        const bool begins = followed.chunks.empty() || names != followed.names;
        if (begins) followed.chunks += (followed.chunks.empty() ? "" : "]},") + chunk_head(port, names);
        followed.names = names;
        followed.chunks +=
            (begins ? "" : ",") + row(record.sequence, followed.clock.time_of(record.stamp), values);
        if (!whole || names.size() < MessageNumbers::max_numbers) return;
        followed.message = std::move(message);
        followed.whole_ns = shm::now_ns();
    } catch (const std::runtime_error&) { // untrusted bytes of another process: the state says so
    }
}

void SampleFeed::add_picture(const SamplePort& port, Followed& followed, const command::FollowedPort& of,
                             const shm::FollowedRecord& record) {
    std::vector<std::byte> message;
    command::append_message(of, record.bytes, record.stamp, message);
    const auto picture = picture_in(of.message, message);
    if (!picture) return; // the state says so
    followed.frame = std::make_shared<const std::string>(picture_frame(port, *picture));
    followed.whole_ns = shm::now_ns();
}

} // namespace tandem::monitor
