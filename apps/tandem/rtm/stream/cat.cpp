// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/print_note.hpp"
#include "apps/tandem/rtm/stream/cdr_json_converter.hpp"
#include "apps/tandem/rtm/stream/type_codes.hpp"
#include "apps/tandem/rtm/stream/untyped_ports.hpp"

#include <chrono>
#include <cstdio>
#include <fmt/format.h>
#include <optional>

namespace tandem::command {
namespace {

/// Returns bytes as `00 01 2a ...`.
std::string hex_dump(const RTC::ByteData& bytes) {
    std::string text;
    for (unsigned long i = 0; i < bytes.getDataLength(); ++i)
        text += fmt::format("{}{:02x}", i == 0 ? "" : " ", bytes.getBuffer()[i]);
    return text;
}

/// Returns a sample as JSON; its bytes if `raw`, if its type is unknown, or if they do not fit the type.
Json sample_json(const CdrJsonConverter& converter, CORBA::TypeCode_ptr type, const RTC::ByteData& bytes,
                 bool raw) {
    if (raw || CORBA::is_nil(type)) return {{"cdr", hex_dump(bytes)}};
    try {
        return converter.to_json(type, bytes);
    } catch (const DataConversionError& error) {
        return {{"cdr", hex_dump(bytes)}, {"error", error.what()}};
    }
}

/// Returns one line that says why no values arrive and what to do.
std::string describe_wait(const RemotePort& port) {
    const std::string component = port.name.substr(0, port.name.rfind('.'));
    std::string state = "does not answer";
    try {
        RTC::RTObject_ptr owner = port.profile->owner;
        if (!CORBA::is_nil(owner)) state = "is " + component_state(owner);
    } catch (const CORBA::Exception&) {
        // the line says that it does not answer
    }
    if (state == "is ACTIVE") return fmt::format("waiting for {} to write to {}", component, port.name);
    return fmt::format("waiting for {}: {} {}; run tandem rtm {} {}", port.name, component, state,
                       state == "is ERROR" ? "reset" : "activate", component);
}

/// The connection of cat's port. Reconnects if the remote port dropped the connection: a port of
/// OpenRTM-aist silently drops it after one failed call to this process, for example on a loaded machine.
class KeptConnection {
  public:
    KeptConnection(const RemotePort& remote, RTC::PortBase& own, const StreamOptions& options)
        : remote_(remote), own_(own), options_(options) {
        connect();
    }
    /// Reconnects if needed. Call this when no value has arrived for a while.
    void restore() {
        if (connection_->exists_at_remote_port()) return;
        print_note("tandem: {} dropped the connection; reconnecting\n", remote_.name);
        connect();
    }

  private:
    void connect() { connection_.emplace(remote_, own_, options_.properties, "tandem-cat"); }
    const RemotePort& remote_;
    RTC::PortBase& own_;
    const StreamOptions& options_;
    std::optional<PortConnection> connection_;
};

} // namespace

int rtm_cat(const RtmClientOptions& client_options, const StreamOptions& options) {
    for (const auto& library : options.types) load_type_library(library);
    interrupted(); // installs the handlers: from here on SIGINT ends the loop and the connection is closed
    const RtmClient client(client_options, true);
    const CdrJsonConverter converter(client.orb());
    const RemotePort remote_port = find_port(client, options.port);
    const std::string type = require_data_type(remote_port, "DataOutPort");
    CORBA::TypeCode_var code = CORBA::TypeCode::_duplicate(find_type_code(type));
    // Not an error: bytes still show whether and how often the port sends.
    if (CORBA::is_nil(code.in()) && !options.raw)
        print_note("{} has type {}, which is unknown here: printing bytes; to see members, give the "
                   "component's library with --types LIBRARY\n",
                   remote_port.name, type);
    UntypedInPort port("in", type.c_str());
    KeptConnection connection(remote_port, port, options);
    // --for counts from the connection, not from the search for the component.
    const auto begin = std::chrono::steady_clock::now();
    auto last_sign = begin; // the last value, or the last check of the connection
    unsigned long received = 0;
    bool has_said_that_it_waits = false;
    const coil::Properties properties = connection_properties(options.properties);
    warn_about_properties(properties);
    const bool pulls = properties.getProperty("dataport.dataflow_type") == "pull";
    while (!interrupted() && (options.count == 0 || received < options.count)) {
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
        if (options.timeout_s > 0 && spent.count() > options.timeout_s) break;
        if (received == 0 && spent.count() > 1 && !has_said_that_it_waits) {
            print_note("tandem: {}\n", describe_wait(remote_port));
            has_said_that_it_waits = true;
        }
        RTC::ByteData bytes;
        // The wait is short, because a signal does not end it, and a pull connection must be polled.
        if (!port.samples().pop(bytes, std::chrono::milliseconds(pulls ? 10 : 100))) {
            if (pulls) port.fetch();
            if (std::chrono::steady_clock::now() - last_sign > std::chrono::seconds(2)) {
                connection.restore();
                last_sign = std::chrono::steady_clock::now();
            }
            continue;
        }
        last_sign = std::chrono::steady_clock::now();
        ++received;
        // One line per value, flushed immediately, because another program may read them through a pipe.
        print_text(sample_json(converter, code.in(), bytes, options.raw)
                       .dump(-1, ' ', false, Json::error_handler_t::replace) +
                   "\n");
        std::fflush(stdout);
    }
    // Fails so that a waiting script notices missing values. A user who interrupts knows.
    if (options.count > 0 && received < options.count && !interrupted())
        throw std::runtime_error(fmt::format("only {} of {} values arrived within {} s; is {} active?",
                                             received, options.count, options.timeout_s,
                                             remote_port.name.substr(0, remote_port.name.rfind('.'))));
    return 0;
}

} // namespace tandem::command
