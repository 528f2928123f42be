// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/replay/comparison.hpp"

#include "apps/tandem/observe/message_json.hpp"
#include "proxy/wire/signature_match.hpp"
#include "proxy/wire/time.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tandem::command {
namespace {

using Json = nlohmann::ordered_json;
using Kind = RecordedChannel::Kind;

std::string text_of(const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }

/// Describes the first member in which two values of a type differ, for example `data[1] was 0.5 and is 0.25`; "" if
/// none.
std::string first_difference_of(const Json& was, const Json& is, const std::string& path) {
    const auto below = [&](const std::string& member) {
        return path.empty() || member[0] == '[' ? path + member : path + "." + member;
    };
    if (was.is_object() && is.is_object() && was.size() == is.size()) {
        for (const auto& [name, value] : was.items())
            if (is.contains(name))
                if (auto found = first_difference_of(value, is[name], below(name)); !found.empty())
                    return found;
    } else if (was.is_array() && is.is_array()) {
        for (std::size_t i = 0; i < std::min(was.size(), is.size()); ++i)
            if (auto found = first_difference_of(was[i], is[i], below(fmt::format("[{}]", i)));
                !found.empty())
                return found;
        if (was.size() != is.size())
            return fmt::format("{} had {} elements and has {}", path, was.size(), is.size());
    }
    if (was == is) return "";
    return fmt::format("{} was {} and is {}", path.empty() ? "the message" : path, text_of(was), text_of(is));
}

std::string where_of(const std::optional<std::uint64_t>& tick) {
    return tick ? fmt::format("tick {}, ", *tick) : "";
}

/// Returns the word for the messages of a channel.
const char* noun_of(const RecordedChannel& channel) {
    if (channel.kind == Kind::request) return "call";
    return channel.kind == Kind::message ? "message" : "reply";
}

} // namespace

void Comparison::set_tick(std::uint64_t tick) {
    const std::lock_guard lock(mutex_);
    tick_ = tick;
}

void Comparison::expect(const RecordedChannel& channel, std::uint64_t stamp,
                        std::span<const std::byte> bytes) {
    const std::lock_guard lock(mutex_);
    Topic& topic = topics_[channel.topic];
    topic.channel = &channel;
    topic.expected.push_back({{bytes.begin(), bytes.end()}, stamp, tick_});
    compare(channel.topic, topic);
}

void Comparison::receive(const std::string& name, std::uint64_t stamp, std::span<const std::byte> bytes) {
    const std::lock_guard lock(mutex_);
    Topic& topic = topics_[name];
    topic.received.push_back({{bytes.begin(), bytes.end()}, stamp, tick_});
    compare(name, topic);
}

void Comparison::differ(const std::string& topic, const std::string& what) {
    const std::lock_guard lock(mutex_);
    note_difference(topic, where_of(tick_), what);
}

void Comparison::note_difference(const std::string& topic, const std::string& where,
                                 const std::string& what) {
    if (different_++ == 0) first_ = fmt::format("{}{}: {}", where, topic, what);
}

/// Call this with mutex_ held.
void Comparison::compare(const std::string& name, Topic& topic) {
    while (!topic.expected.empty() && !topic.received.empty()) {
        const Item expected = std::move(topic.expected.front()), received = std::move(topic.received.front());
        topic.expected.pop_front();
        topic.received.pop_front();
        ++topic.compared;
        if (expected.bytes == received.bytes && (!times_ || expected.stamp == received.stamp))
            ++same_;
        else
            note_difference(name,
                            where_of(expected.tick) +
                                fmt::format("{} {} of ", noun_of(*topic.channel), topic.compared),
                            describe(topic, expected, received));
    }
    if (topic.expected.empty()) topic.is_late = false;
}

std::string Comparison::describe(const Topic& topic, const Item& expected, const Item& received) const {
    const RecordedChannel& channel = *topic.channel;
    const auto value_of = [&](const Item& item) {
        std::vector<std::byte> message;
        const bool timed = channel.kind == Kind::message && channel.timed;
        if (timed || channel.kind != Kind::message) { // a time, or a call number that is equal on both sides
            const std::uint32_t front[2] = {timed && times_ ? wire::stamp_seconds(item.stamp) : 0,
                                            timed && times_ ? wire::stamp_nanoseconds(item.stamp) : 0};
            const auto begin = std::as_bytes(std::span(front));
            message.assign(begin.begin(), begin.end());
        }
        message.insert(message.end(), item.bytes.begin(), item.bytes.end());
        return message_to_json(channel.type, message);
    };
    try {
        if (auto found = first_difference_of(value_of(expected), value_of(received), ""); !found.empty())
            return found;
    } catch (const std::runtime_error& error) { // the live system has sent something else
        return error.what();
    }
    if (expected.bytes == received.bytes) return "the times of sending differ";
    return "the bytes differ, although the values are equal";
}

bool Comparison::is_complete() const {
    const std::lock_guard lock(mutex_);
    return std::all_of(topics_.begin(), topics_.end(),
                       [](const auto& each) { return each.second.expected.empty(); });
}

bool Comparison::is_waiting() const {
    const std::lock_guard lock(mutex_);
    return std::any_of(topics_.begin(), topics_.end(),
                       [](const auto& each) { return each.second.is_waited_for(); });
}

std::vector<std::string> Comparison::stop_waiting() {
    const std::lock_guard lock(mutex_);
    std::vector<std::string> names;
    for (auto& [name, topic] : topics_) {
        if (!topic.is_waited_for()) continue;
        topic.is_late = true;
        names.push_back(name);
    }
    return names;
}

void Comparison::finish(bool complete) {
    const std::lock_guard lock(mutex_);
    for (auto& [name, topic] : topics_) {
        const std::size_t missing = topic.expected.size(), more = topic.received.size();
        if (missing == 0 && more == 0) continue;
        const std::string what = missing != 0 ? fmt::format("{} missing from the replay", missing)
                                              : fmt::format("{} not in the recording", more);
        if (complete)
            note_difference(name,
                            missing != 0 ? where_of(topic.expected.front().tick)
                                         : where_of(topic.received.front().tick),
                            what);
        else
            notes_.push_back(name + ": " + what);
    }
}

} // namespace tandem::command
