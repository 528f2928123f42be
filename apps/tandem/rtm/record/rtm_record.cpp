// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/rtm/record/rtm_record.hpp"

#include "apps/tandem/mcap/writer.hpp"
#include "apps/tandem/observe/message_idl.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/print_note.hpp"
#include "apps/tandem/record/cdr_message.hpp"
#include "apps/tandem/record/drops.hpp"
#include "apps/tandem/record/recording_clock.hpp"
#include "apps/tandem/record/recording_output.hpp"
#include "apps/tandem/rtm/record/recorded_port.hpp"
#include "apps/tandem/rtm/running/component_source.hpp"
#include "apps/tandem/rtm/stream/type_codes.hpp"
#include "proxy/interceptor/corba/transcoder.hpp"
#include "proxy/wire/signature_match.hpp"

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <rtm/CORBA_RTCUtil.h>
#include <rtm/InterfaceSignatures.h>
#include <rtm/NVUtil.h>
#include <span>
#include <string>
#include <vector>

namespace tandem::command {
namespace {

/// Throws std::runtime_error if the type is unknown.
wire::Type known_type(const RemotePort& port, const std::string& type) {
    CORBA::TypeCode_var code = CORBA::TypeCode::_duplicate(find_type_code(type));
    if (CORBA::is_nil(code.in()))
        throw std::runtime_error(
            fmt::format("{} has type {}, which is unknown here; give the component's library with --types",
                        port.name, type));
    wire::Type message = wire::parse_signature(RTC::InterfaceSignatures::signature(code.in()));
    if (wire::contains(message, wire::Kind::unsupported))
        throw std::runtime_error(fmt::format(
            "{} has type {}, which cannot be recorded because it contains itself", port.name, type));
    return message;
}

/// Converts a message to little-endian CDR. Throws CORBA::SystemException if the bytes are not a message of the type.
std::vector<std::byte> little_endian(const wire::Type& message, const RTC::ByteData& bytes) {
    std::vector<std::byte> converted;
    cdrMemoryStream stream(bytes.getBuffer(), bytes.getDataLength());
    stream.setByteSwapFlag(bytes.getEndian());
    wire::CdrWriter out(converted);
    interceptor::to_cdr(message, stream, out);
    return converted;
}

std::uint64_t time_of(std::span<const std::byte> message) {
    wire::CdrReader reader(message);
    const auto seconds = reader.get<std::uint32_t>(), nanoseconds = reader.get<std::uint32_t>();
    return std::uint64_t{seconds} * 1'000'000'000ULL + nanoseconds;
}

/// Writes the messages of OutPorts to an MCAP file. Each port is a channel `/COMPONENT/PORT` with CDR messages, their
/// encapsulation, and the type as IDL. Log time: reception, see RecordingClock; publish time: the sender's `tm`, if
/// any. `/tandem/drops` counts lost messages. [main-thread]
class RtmRecorder {
  public:
    /// `writer` must outlive the recorder.
    explicit RtmRecorder(mcap::McapWriter& writer) : writer_(writer), clock_channel_(writer, clock_) {}

    /// Connects to an OutPort and starts to record it. Returns false, without side effects, if it is already recorded.
    /// Throws std::runtime_error if the port is of another kind, its type is unknown, or the connection fails.
    bool add(RemotePort port, const std::vector<std::string>& properties) {
        for (const Channel& channel : ports_)
            if (channel.port->remote().object->_is_equivalent(port.object.in())) return false;
        const std::string type = require_data_type(port, "DataOutPort");
        const wire::Type message = known_type(port, type);
        const MessageIdl idl = message_idl(type, message);
        const auto dot = port.name.rfind('.');
        const std::string component = port.name.substr(0, dot == std::string::npos ? 0 : dot);
        const std::string name = port.name.substr(dot == std::string::npos ? 0 : dot + 1);
        clock_channel_.write_start();
        Channel channel;
        channel.timed = wire::is_timed(message);
        channel.port =
            std::make_unique<RecordedPort>(std::move(port), message, ports_.size(), samples_, properties);
        auto& schema = schemas_[type];
        if (schema == 0) schema = writer_.add_schema(idl.name, "omgidl", bytes_of(idl.text));
        channel.id = writer_.add_channel("/" + component + "/" + name, schema, "cdr",
                                         {{"tandem.port", name},
                                          {"tandem.component", component},
                                          {"tandem.type", type},
                                          {"tandem.signature", wire::to_named_signature(message)}});
        ports_.push_back(std::move(channel));
        return true;
    }

    /// Writes received messages, and waits for the first at most for `timeout`. Throws mcap::Error.
    void write_received(std::chrono::milliseconds timeout) {
        for (const ReceivedSample& sample : samples_.take(timeout)) write(sample);
    }

    /// Writes changed counts of dropped messages and a step of the wall clock, and reconnects where needed. Calls the components.
    void look_after() {
        clock_channel_.write_step();
        for (Channel& channel : ports_) {
            Drops drops = channel.drops;
            drops.not_recorded = channel.port->dropped() + channel.undecodable;
            if (const auto lost = channel.port->lost_by_sender()) drops.overwritten = *lost;
            write_drops(channel, drops);
            const std::uint64_t received = channel.port->received();
            if (std::exchange(channel.seen, received) != received) continue; // the connection works
            try {
                if (channel.port->restore())
                    print_note("tandem: {} dropped the connection; reconnected\n",
                               channel.port->remote().name);
            } catch (const std::runtime_error& error) {
                print_note("tandem: {}\n", error.what());
            }
        }
    }

    std::uint64_t messages() const { return messages_; }
    std::uint64_t not_recorded() const {
        std::uint64_t count = 0;
        for (const Channel& channel : ports_) count += channel.drops.not_recorded;
        return count;
    }

    std::uint64_t lost_by_senders() const {
        std::uint64_t count = 0;
        for (const Channel& channel : ports_) count += channel.drops.overwritten;
        return count;
    }

    std::size_t ports() const { return ports_.size(); }

  private:
    struct Channel {
        std::unique_ptr<RecordedPort> port;
        std::uint16_t id = 0;
        bool timed = false;
        std::uint32_t sequence = 0;
        std::uint64_t undecodable = 0, seen = 0;
        Drops drops{}; ///< as last written
    };
    void write(const ReceivedSample& sample) {
        Channel& channel = ports_.at(sample.port);
        message_.assign(std::begin(encapsulation), std::end(encapsulation));
        const auto bytes = std::as_bytes(std::span(sample.bytes.getBuffer(), sample.bytes.getDataLength()));
        if (sample.bytes.getEndian() && wire::is_plain(channel.port->message())) {
            message_.insert(message_.end(), bytes.begin(), bytes.end());
        } else {
            try {
                const auto converted = little_endian(channel.port->message(), sample.bytes);
                message_.insert(message_.end(), converted.begin(), converted.end());
            } catch (const CORBA::SystemException&) {
                ++channel.undecodable;
                return;
            }
        }
        const auto payload = std::span(message_).subspan(sizeof encapsulation);
        const std::uint64_t time = clock_.time_of(sample.time_ns);
        writer_.write(channel.id, ++channel.sequence, time, channel.timed ? time_of(payload) : time,
                      message_);
        ++messages_;
    }

    void write_drops(Channel& channel, const Drops& drops) {
        if (drops == channel.drops) return;
        channel.drops = drops;
        if (drops_channel_ == 0)
            drops_channel_ = writer_.add_channel(
                "/tandem/drops", writer_.add_schema(drops_type, "omgidl", bytes_of(drops_idl)), "cdr");
        message_.assign(std::begin(encapsulation), std::end(encapsulation));
        const auto bytes = encode(channel.port->remote().name, drops);
        message_.insert(message_.end(), bytes.begin(), bytes.end());
        const std::uint64_t now = clock_.now();
        writer_.write(drops_channel_, ++drops_sequence_, now, now, message_);
    }

    mcap::McapWriter& writer_;
    RecordingClock clock_;
    ClockChannel clock_channel_;
    ReceivedSamples samples_; ///< must outlive the ports
    std::vector<Channel> ports_;
    std::map<std::string, std::uint16_t> schemas_; ///< by type
    std::uint16_t drops_channel_ = 0;
    std::uint32_t drops_sequence_ = 0;
    std::uint64_t messages_ = 0;
    std::vector<std::byte> message_; ///< reused, so that messages need no allocation
};

/// Buffers on the sender's side between two deliveries, so that its component does not wait for this program.
const std::vector<std::string> default_properties{
    "interface_type=corba_cdr",     "dataflow_type=push",
    "subscription_type=new",        "publisher.push_policy=all",
    "outport.buffer.length=1024",   "outport.buffer.write.full_policy=overwrite",
    "serializer.cdr.endian=little", "report_lost=YES"};

/// Returns all OutPorts of a component.
std::vector<RemotePort> out_ports_of(RTC::RTObject_ptr component) {
    std::vector<RemotePort> found;
    RTC::PortServiceList_var ports = component->get_ports();
    for (CORBA::ULong i = 0; i < ports->length(); ++i) {
        RemotePort port;
        port.object = RTC::PortService::_duplicate(ports[i]);
        port.profile = ports[i]->get_port_profile();
        port.name = port.profile->name;
        if (NVUtil::toString(port.profile->properties, "port.port_type") == "DataOutPort")
            found.push_back(std::move(port));
    }
    return found;
}

/// Returns `COMPONENT:PORT`, or all OutPorts of `COMPONENT`.
std::vector<RemotePort> find_out_ports(const RtmClient& client, const std::string& name) {
    const std::size_t last = name.rfind('/') == std::string::npos ? 0 : name.rfind('/');
    std::vector<RemotePort> found;
    if (name.find(':', last) != std::string::npos) {
        found.push_back(find_port(client, name));
        return found;
    }
    const RemoteComponent component = client.find_component(name);
    found = call_remote(component.address, [&] { return out_ports_of(component.object.in()); });
    if (found.empty()) throw std::runtime_error(component.instance + " has no OutPort");
    return found;
}

/// Returns the OutPorts of all reachable components. Skips the ends of links, because their ports mirror other ports.
std::vector<RemotePort> all_out_ports(const RtmClient& client) {
    std::vector<RemotePort> found;
    const auto sources = enumerate_components(client);
    throw_if_sources_failed(client, sources);
    for (const auto& source : sources)
        for (const auto& entry : source.components) {
            if (!entry.error.empty() || CORBA::is_nil(entry.object.in()) || entry.type == "InterceptorComp")
                continue;
            try {
                for (auto& port : out_ports_of(entry.object.in())) found.push_back(std::move(port));
            } catch (const CORBA::Exception&) { // gone meanwhile
            }
        }
    return found;
}

void add_ports(const RtmClient& client, const RtmRecordOptions& options, RtmRecorder& recorder) {
    std::vector<std::string> properties = default_properties;
    properties.insert(properties.end(), options.properties.begin(), options.properties.end());
    for (const auto& name : options.ports)
        for (auto& port : find_out_ports(client, name)) recorder.add(std::move(port), properties);
    if (!options.ports.empty()) return;
    // Without explicit ports, a port that cannot be recorded does not affect the others.
    for (auto& port : all_out_ports(client)) {
        try {
            recorder.add(std::move(port), properties);
        } catch (const std::runtime_error& error) {
            print_note("tandem: left out: {}\n", error.what());
        }
    }
    if (recorder.ports() == 0) throw std::runtime_error("no component has an OutPort that can be recorded");
}

double record_messages(const RtmRecordOptions& options, mcap::McapWriter& writer, RtmRecorder& recorder) {
    const auto begin = std::chrono::steady_clock::now();
    auto flushed = begin;
    const auto since = [](auto time) { return std::chrono::steady_clock::now() - time; };
    const auto seconds = [&] { return std::chrono::duration<double>(since(begin)).count(); };
    while (!interrupted() && (options.duration_s <= 0 || seconds() < options.duration_s)) {
        recorder.write_received(std::chrono::milliseconds(50));
        if (since(flushed) < std::chrono::nanoseconds(flush_interval_ns)) continue;
        flushed = std::chrono::steady_clock::now();
        recorder.look_after();
        writer.flush();
    }
    recorder.write_received(std::chrono::milliseconds(0));
    recorder.look_after();
    return seconds();
}

/// Connects to the ports and records to the file, even if it becomes full. Returns the time in s.
double record_to(RecordingOutput& output, const RtmClient& client, const RtmRecordOptions& options,
                 RtmRecorder& recorder) {
    try {
        add_ports(client, options, recorder);
        return record_messages(options, output.writer(), recorder);
    } catch (const mcap::Error& error) {
        output.end_after(error);
    }
}

} // namespace

int rtm_record(const RtmClientOptions& client_options, const RtmRecordOptions& options) {
    for (const auto& library : options.types) load_type_library(library);
    interrupted();                 // installs the handlers
    std::signal(SIGPIPE, SIG_IGN); // a gone reader of the output must not end the recording
    const RtmClient client(client_options, true);
    RecordingOutput output(recording_file(options, "rtm"), writer_options(options));
    RtmRecorder recorder(output.writer());
    const double seconds = record_to(output, client, options, recorder);
    output.close();
    const std::string& name = output.name();
    if (client_options.json)
        print_json({{"file", name},
                    {"messages", recorder.messages()},
                    {"ports", recorder.ports()},
                    {"seconds", seconds},
                    {"not_recorded", recorder.not_recorded()},
                    {"lost_by_senders", recorder.lost_by_senders()}});
    else
        print_text(fmt::format(
            "{}: {} messages of {} ports in {:.1f} s, {}; {} not recorded, {} lost by their senders\n", name,
            recorder.messages(), recorder.ports(), seconds, format_bytes(output.writer().bytes_written()),
            recorder.not_recorded(), recorder.lost_by_senders()));
    return 0;
}

} // namespace tandem::command
