// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/replay/recording.hpp"

#include "apps/tandem/record/cdr_message.hpp"
#include "proxy/adaptor/model.hpp"
#include "proxy/interceptor/model.hpp"
#include "proxy/link/protocol/link_error.hpp"
#include "proxy/wire/cdr.hpp"
#include "proxy/wire/signature_match.hpp"
#include "proxy/wire/time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <set>
#include <stdexcept>

namespace tandem::command {
namespace {

using Kind = RecordedChannel::Kind;

/// Length of the RTM time before a message, or of the call's number before arguments and results.
constexpr std::size_t prefix_bytes = 8;
constexpr std::uint64_t ns_per_s = 1'000'000'000;

shm::Side side_of(const std::string& name) {
    return name == shm::name_of(shm::Side::first) ? shm::Side::first : shm::Side::second;
}

std::string value_of(const mcap::StringMap& metadata, const char* name) {
    const auto found = metadata.find(name);
    return found == metadata.end() ? "" : found->second;
}

std::optional<Kind> kind_of(const mcap::Channel& channel) {
    if (channel.topic == steps_topic) return Kind::step;
    const std::string kind = value_of(channel.metadata, "tandem.kind");
    if (kind == request_kind) return Kind::request;
    if (kind == reply_kind) return Kind::reply;
    if (kind == failure_kind) return Kind::failure;
    if (channel.metadata.contains("tandem.writer")) return Kind::message;
    return std::nullopt; // drops, or a channel of another program
}

} // namespace

bool RecordedLink::is_adaptor(shm::Side side) const { return table(side).model == adaptor::model; }

std::string RecordedLink::host_of(shm::Side side) const {
    if (is_adaptor(side)) return "opros_host";
    return table(side).model == interceptor::model ? "rtm_host" : "";
}

Recording::Recording(const std::filesystem::path& file)
    : file_(file), reader_(file), problems_(reader_.contents().problems) {
    read_channels();
    read_metadata();
    if (links_.empty())
        throw std::runtime_error(file.string() + ": has no port tables of a link, so it cannot be replayed; "
                                                 "record with tandem record or with --lockstep --record");
    rewind();
}

void Recording::read_metadata() {
    for (const auto& index : reader_.contents().metadata) {
        if (index.name != "tandem.ports" && index.name != "tandem.lockstep") continue;
        const auto metadata = reader_.metadata(index).metadata;
        if (index.name == "tandem.lockstep") {
            tick_ns_ = std::strtoull(value_of(metadata, "tick_ns").c_str(), nullptr, 10);
            continue;
        }
        const std::string name = value_of(metadata, "link");
        RecordedLink& link = links_[name];
        link.name = name;
        const shm::Side side = side_of(value_of(metadata, "side"));
        try {
            link::PortTable table = link::decode_port_table_text(value_of(metadata, "table"));
            // Before 0.3.0, tables named no model: the first side was always OPRoS.
            if (table.model.empty())
                table.model = side == shm::Side::first ? adaptor::model : interceptor::model;
            link.tables[shm::index_of(side)] = std::move(table);
        } catch (const link::LinkError& error) {
            throw std::runtime_error(fmt::format("{}: {}", file_.string(), error.what()));
        }
    }
    has_steps_ = has_steps_ && tick_ns_ != 0;
}

void Recording::read_channels() {
    for (const auto& [id, channel] : reader_.contents().channels) {
        const auto kind = kind_of(channel);
        if (!kind) continue;
        const auto& metadata = channel.metadata;
        has_steps_ = has_steps_ || *kind == Kind::step;
        RecordedChannel& known = channels_[id];
        known = {*kind,
                 value_of(metadata, "tandem.link"),
                 value_of(metadata, "tandem.port"),
                 channel.topic,
                 side_of(value_of(metadata, *kind == Kind::message ? "tandem.writer" : "tandem.callers")),
                 value_of(metadata, "tandem.operation"),
                 value_of(metadata, "tandem.operation_signature")};
        try {
            known.type = wire::parse_signature(value_of(metadata, "tandem.signature"));
        } catch (const wire::SignatureError& error) {
            throw std::runtime_error(
                fmt::format("{}: topic {}: {}", file_.string(), channel.topic, error.what()));
        }
        known.timed = *kind == Kind::message && wire::is_timed(known.type);
    }
}

void Recording::rewind() {
    mcap::Query query;
    query.in_log_time_order = true;
    query.channels.emplace();
    for (const auto& [id, channel] : channels_) query.channels->insert(id);
    cursor_.emplace(reader_.messages(std::move(query)));
}

std::optional<RecordedEvent> Recording::next() {
    const auto message = cursor_->next();
    if (!message) {
        for (const std::string& problem : cursor_->problems())
            if (std::find(problems_.begin(), problems_.end(), problem) == problems_.end())
                problems_.push_back(problem);
        return std::nullopt;
    }
    const RecordedChannel& channel = channels_.at(message->channel_id);
    const auto fail = [&] {
        throw std::runtime_error(
            fmt::format("{}: message {} of topic {} does not match the type of the topic", file_.string(),
                        message->sequence, channel.topic));
    };
    if (message->data.size() < sizeof encapsulation ||
        !std::equal(std::begin(encapsulation), std::end(encapsulation), message->data.begin()))
        fail();
    const auto payload = message->data.subspan(sizeof encapsulation);
    bytes_.resize(payload.size() / sizeof(std::uint64_t) + 1);
    std::memcpy(bytes_.data(), payload.data(), payload.size());
    const auto bytes = std::as_bytes(std::span(bytes_)).first(payload.size());
    RecordedEvent event{.channel = &channel, .time_ns = message->log_time, .bytes = bytes};
    if (channel.kind == Kind::step) {
        wire::CdrReader in(bytes);
        event.tick = in.get<std::uint64_t>();
        event.host = in.get_string();
        event.component = in.get_string();
        if (!in.ok()) fail();
        return event;
    }
    if (channel.kind == Kind::message && !channel.timed) {
        event.stamp = wire::pack_time(static_cast<std::uint32_t>(message->publish_time / ns_per_s),
                                      static_cast<std::uint32_t>(message->publish_time % ns_per_s));
        return event;
    }
    if (bytes.size() < prefix_bytes) fail();
    event.bytes = bytes.subspan(prefix_bytes);
    if (channel.kind == Kind::message) {
        std::uint32_t time[2] = {};
        std::memcpy(time, bytes.data(), sizeof time);
        event.stamp = wire::pack_time(time[0], time[1]);
    } else {
        std::memcpy(&event.call, bytes.data(), sizeof event.call);
    }
    return event;
}

} // namespace tandem::command
