// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/rtm/requests/publishers.hpp"

#include "proxy/interceptor/corba/transcoder.hpp"
#include "proxy/wire/cdr.hpp"
#include "proxy/wire/time.hpp"

#include <fmt/format.h>

#include <span>

namespace tandem::command {
namespace {

/// Encodes a message like RTC::write(). Throws std::runtime_error if the bytes are not a message of the type.
RTC::ByteData encode_message(const wire::Type& message, const std::string& bytes, bool add_time) {
    cdrMemoryStream stream;
    if (add_time) { // 8 bytes, which keep the alignment
        const std::uint64_t now = wire::wall_clock_stamp();
        wire::stamp_seconds(now) >>= stream;
        wire::stamp_nanoseconds(now) >>= stream;
    }
    wire::CdrReader reader(std::as_bytes(std::span(bytes)));
    try {
        interceptor::from_cdr(message, reader, stream);
    } catch (const CORBA::SystemException&) {
        reader.fail();
    }
    // CDR writers may pad the end of a message.
    if (!reader.ok() || reader.remaining() >= 8)
        throw std::runtime_error(fmt::format("the message of {} bytes is not a valid {}", bytes.size(),
                                             wire::to_named_signature(message)));
    RTC::ByteData data;
    data.writeData(static_cast<unsigned char*>(stream.bufPtr()), stream.bufSize());
    data.isLittleEndian(true);
    return data;
}

} // namespace

void Publishers::open(const nlohmann::json& request) {
    const auto pid = request.at("pid").get<std::uint32_t>();
    const auto link = request.at("link").get<std::string>(), port = request.at("port").get<std::string>();
    const auto component = request.at("component").get<std::string>();
    const auto type = request.at("type").get<std::string>();
    const bool mirror = component.empty();
    RemotePort receiver =
        get_port(mirror ? components_.find_interceptor(pid, link) : components_.find(pid, component), port);
    const std::string actual = require_data_type(receiver, "DataInPort");
    if (!type.empty() && actual != type)
        throw std::runtime_error(fmt::format("{} carries {}, not {}", receiver.name, actual, type));
    // "flush" reports the result of each send().
    std::vector<std::string> properties{"interface_type=corba_cdr", "dataflow_type=push",
                                        "subscription_type=flush", "serializer.cdr.endian=little"};
    // The buffer at the link's own end is the ring. The host writes there, in turn with its other writers.
    if (mirror)
        for (const auto& property :
             {std::string("inport.buffer_type=tandem_link"), "inport.buffer.channel=" + link + "/" + port})
            properties.push_back(property);
    auto publisher = std::unique_ptr<Publisher>(new Publisher{
        std::move(receiver), wire::parse_signature(request.at("signature").get<std::string>()),
        UntypedOutPort("publish", actual.c_str()), request.at("add_time").get<bool>(), nullptr});
    publisher->connection =
        std::make_unique<PortConnection>(publisher->receiver, publisher->port, properties, "tandem-monitor");
    publishers_[request.at("publisher").get<int>()] = std::move(publisher);
}

void Publishers::send(const Frame& request) {
    const auto found = publishers_.find(request.head.at("publisher").get<int>());
    if (found == publishers_.end()) return; // opening it has failed, and this was reported
    Publisher& publisher = *found->second;
    const auto message = encode_message(publisher.message, request.bytes, publisher.add_time);
    try {
        publisher.port.send(message, publisher.receiver.name);
    } catch (const ConnectionLost& error) { // reported once; further messages are ignored
        publishers_.erase(found);
        throw std::runtime_error(std::string(error.what()) + ": advertise it again");
    }
}

} // namespace tandem::command
