// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/foxglove/client_publisher.hpp"

#include "apps/tandem/observe/json_message.hpp"
#include "apps/tandem/observe/message_idl.hpp"
#include "apps/tandem/record/cdr_message.hpp"
#include "proxy/interceptor/model.hpp"

#include <fmt/format.h>

#include <bit>
#include <cctype>
#include <stdexcept>

namespace tandem::monitor {
namespace {

using PlainJson = nlohmann::json;

/// Removes white space and comments, to compare two texts of a schema.
std::string condensed(const std::string& idl) {
    std::string text;
    for (std::size_t i = 0; i < idl.size(); ++i) {
        if (idl.compare(i, 2, "//") == 0) i = std::min(idl.find('\n', i), idl.size() - 1);
        if (std::isspace(static_cast<unsigned char>(idl[i])) == 0)
            text += idl[i];
        else if (!text.empty() && text.back() != ' ')
            text += ' ';
    }
    return text;
}

/// Throws std::runtime_error if the client's type differs from the port's.
void check_type(const PlainJson& channel, const command::MessageIdl& idl) {
    const auto encoding = channel.at("encoding").get<std::string>();
    if (encoding != "cdr" && encoding != "json")
        throw std::runtime_error("expected encoding cdr or json, not " + encoding);
    const auto name = channel.value("schemaName", std::string());
    if (name != idl.name && (encoding == "cdr" || !name.empty()))
        throw std::runtime_error(fmt::format("the type of the port is {}, not {}", idl.name, name));
    const auto schema = channel.value("schema", std::string());
    if (!schema.empty() && channel.value("schemaEncoding", std::string("omgidl")) == "omgidl" &&
        condensed(schema) != condensed(idl.text))
        throw std::runtime_error(fmt::format("the schema of {} differs from the port's, which is: {}",
                                             idl.name, condensed(idl.text)));
}

} // namespace

nlohmann::json receiver_of(const command::FollowedPort& followed, const LinkState& link) {
    const auto& port = followed.port;
    const auto rtm = link.side_of(interceptor::model);
    if (!rtm || link.side(*rtm).state != shm::PeerState::alive)
        throw std::runtime_error("the RTM host that forwards messages is not running");
    if (port.is_event_in_port())
        throw std::runtime_error(
            "publishing to an EventInPort, which has several event types, is not supported");
    for (const wire::Type& member : followed.message.children)
        if (!command::takes_bytes(member))
            throw std::runtime_error("messages with an any or with empty structures cannot be sent");
    const bool rtc = followed.owner == *rtm, in = port.kind == link::PortKind::data_in;
    if (!rtc && !in)
        throw std::runtime_error(
            "this is an output of an OPRoS component shown as an RTC; publish to an InPort that receives it");
    const std::string prefix = port.component + ".";
    const std::string own_name =
        port.name.compare(0, prefix.size(), prefix) == 0 ? port.name.substr(prefix.size()) : port.name;
    return {{"pid", link.side(*rtm).pid},
            {"link", link.name},
            {"component", in ? port.component : std::string()}, // empty: the host's end of the link
            {"port", in ? own_name : port.name},
            {"type", rtc ? port.type : std::string()},
            {"signature", port.signature},
            {"add_time", !rtc && !followed.timed}};
}

// NOLINTNEXTLINE(bugprone-exception-escape): only without memory, and then the monitor ends
ClientPublisher::~ClientPublisher() {
    for (const auto& [id, channel] : advertised_) program_.remove_publisher(channel.publisher);
}

void ClientPublisher::advertise(const PlainJson& channels) {
    for (const auto& channel : channels) {
        try {
            advertise_one(channel);
        } catch (const std::runtime_error& error) {
            line_.fail(fmt::format("{}: {}", channel.value("topic", "?"), error.what()));
        }
    }
}

void ClientPublisher::advertise_one(const PlainJson& channel) {
    const auto id = channel.at("id").get<std::uint32_t>();
    const auto topic = channel.at("topic").get<std::string>();
    if (advertised_.count(id) != 0 || advertised_.size() >= max_channels)
        throw std::runtime_error(
            fmt::format("channel {} is already advertised, or the limit of 64 is reached", id));
    const auto* const port = channels_.find_port(topic);
    if (port == nullptr) throw std::runtime_error("unknown topic; expected /LINK/PORT of a data port");
    const auto* const link = channels_.find_link(port->link);
    if (link == nullptr) throw std::runtime_error("its link no longer exists");
    check_type(channel, command::message_idl(*port));
    open(id, {0, topic, port->message, channel.at("encoding") == "json", 0}, receiver_of(*port, *link));
}

void ClientPublisher::open(std::uint32_t id, Channel channel, PlainJson request) {
    channel.publisher = program_.add_publisher(
        [weak = weak_from_this(), id, topic = channel.topic](const std::string& text, bool ended) {
            const auto self = weak.lock();
            if (self == nullptr) return;
            self->line_.fail(topic + ": " + text + (ended ? ": advertise it again" : ""));
            if (ended) self->advertised_.erase(id);
        });
    request.update({{"op", "open"}, {"publisher", channel.publisher}});
    advertised_[id] = channel;
    program_.ask({request, {}}, [weak = weak_from_this(), id](const command::Frame& reply) {
        if (const auto self = weak.lock(); self != nullptr && !reply.head.value("ok", false))
            self->drop(id, reply.head.value("text", ""));
    });
}

void ClientPublisher::drop(std::uint32_t id, const std::string& why) {
    const auto found = advertised_.find(id);
    if (found == advertised_.end()) return;
    line_.fail(found->second.topic + ": " + why);
    program_.remove_publisher(found->second.publisher);
    advertised_.erase(found);
}

void ClientPublisher::unadvertise(const PlainJson& ids) {
    for (const auto& id : ids) {
        const auto found = advertised_.find(id.get<std::uint32_t>());
        if (found == advertised_.end()) continue;
        program_.remove_publisher(found->second.publisher);
        advertised_.erase(found);
    }
}

void ClientPublisher::message(std::uint32_t id, std::string_view payload) {
    const auto found = advertised_.find(id);
    if (found == advertised_.end())
        return line_.warn(fmt::format("a message on channel {}, which is not advertised", id));
    Channel& channel = found->second;
    std::string bytes;
    try {
        if (channel.json) {
            const auto message = command::json_to_message(channel.message, command::parse_json(payload));
            bytes.assign(reinterpret_cast<const char*>(message.data()), message.size());
        } else {
            bytes = command::behind_encapsulation(payload);
        }
    } catch (const std::exception& error) { // from JSON or from this file
        return line_.fail(fmt::format("{}: {}", channel.topic, error.what()));
    }
    if (program_.tell({{{"op", "send"}, {"publisher", channel.publisher}}, std::move(bytes)})) return;
    if (std::has_single_bit(++channel.dropped)) // warns after 1, 2, 4, 8 ... messages
        line_.warn(fmt::format("{}: {} messages were dropped because the receiver is too slow", channel.topic,
                               channel.dropped));
}

} // namespace tandem::monitor
