// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/rtm/record/rtm_record.hpp"

#include "apps/tandem/mcap/file_sink.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/print_note.hpp"
#include "apps/tandem/rtm/record/rtm_recorder.hpp"
#include "apps/tandem/rtm/running/component_source.hpp"
#include "apps/tandem/rtm/stream/type_codes.hpp"

#include <fmt/format.h>
#include <rtm/CORBA_RTCUtil.h>
#include <rtm/NVUtil.h>

#include <cstdio>

namespace tandem::command {
namespace {

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

} // namespace

int rtm_record(const RtmClientOptions& client_options, const RtmRecordOptions& options) {
    for (const auto& library : options.types) load_type_library(library);
    interrupted(); // installs the handlers
    const RtmClient client(client_options, true);
    const std::string name = recording_file(options, "rtm");
    mcap::FileSink file(name);
    mcap::McapWriter writer(file, writer_options(options));
    RtmRecorder recorder(writer);
    add_ports(client, options, recorder);
    const double seconds = record_messages(options, writer, recorder);
    writer.close();
    file.close();
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
            recorder.messages(), recorder.ports(), seconds, format_bytes(writer.bytes_written()),
            recorder.not_recorded(), recorder.lost_by_senders()));
    return 0;
}

} // namespace tandem::command
