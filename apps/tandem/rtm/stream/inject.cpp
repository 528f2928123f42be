// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/rtm/stream/cdr_json_converter.hpp"
#include "apps/tandem/rtm/stream/type_codes.hpp"
#include "apps/tandem/rtm/stream/untyped_ports.hpp"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <iostream>
#include <optional>
#include <rtm/NVUtil.h>
#include <thread>

namespace tandem::command {
namespace {

// Uses text that is not JSON as a string, so that `hello` needs no quotes for JSON and the shell.
Json parse_value(const std::string& text) {
    const Json value = Json::parse(text, nullptr, false);
    return value.is_discarded() ? Json(text) : value;
}

// The message quotes the value as given, because a command line can contain several.
RTC::ByteData encode_sample(const CdrJsonConverter& converter, CORBA::TypeCode_ptr type,
                            const std::string& text, bool little_endian) {
    try {
        return converter.to_cdr(type, parse_value(text), little_endian);
    } catch (const DataConversionError& e) {
        throw std::runtime_error("`" + text + "`: " + e.what());
    }
}

/// Observes the values at the receiver. A component can read them only while its InPort is connected.
class Receiver {
  public:
    Receiver(const RemotePort& remote, UntypedOutPort& port, const std::string& connection, double timeout_s)
        : remote_(remote), port_(port), connection_(connection), timeout_(timeout_s) {}

    /// Waits, at most for the timeout, until `sent` values were delivered and read. If the host does not report reads,
    /// waits two cycles of its component. Returns true if the values are known to be read. Throws if they were not
    /// read.
    bool wait_until_read(std::size_t sent) {
        const auto start = std::chrono::steady_clock::now();
        for (;;) {
            const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
            const std::size_t delivered = count_delivered();
            const auto unread = count_unread();
            if (delivered >= sent && unread == 0u) return true;
            if (delivered >= sent && !unread && spent.count() > 2 * period_s()) return false;
            if (interrupted()) return false;
            // An inactive component does not run cycles that read, but another of its threads may still read.
            const std::string state = owner_state();
            if (spent.count() > (state == "ACTIVE" ? timeout_ : std::min(timeout_, 0.5)))
                throw std::runtime_error(
                    describe_failure(sent, delivered, unread.value_or(0), spent.count(), state));
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
    }

  private:
    /// Subtracts queued values for another machine, which the port counts as delivered.
    std::size_t count_delivered() const {
        const RTC::ConnectorProfile_var own = port_.get_connector_profile(connection_.c_str());
        const std::string undelivered = NVUtil::toString(own->properties, "dataport.undelivered");
        const std::size_t counted = port_.delivered();
        return counted - std::min(counted, undelivered.empty() ? std::size_t{0} : std::stoul(undelivered));
    }
    std::optional<std::size_t> count_unread() const {
        return call_remote(remote_.name, [&]() -> std::optional<std::size_t> {
            RTC::ConnectorProfile_var profile = remote_.object->get_connector_profile(connection_.c_str());
            const std::string unread = NVUtil::toString(profile->properties, "dataport.unread");
            if (unread.empty()) return std::nullopt;
            return std::stoul(unread);
        });
    }
    std::string owner_state() const {
        return call_remote(remote_.name, [&] { return component_state(remote_.profile->owner); });
    }
    // Limited, because some contexts have periods of hours.
    double period_s() const {
        return call_remote(remote_.name, [&] {
            const double rate = execution_contexts(remote_.profile->owner).front()->get_rate();
            return rate > 1 ? 1 / rate : 1.0;
        });
    }
    std::string describe_failure(std::size_t sent, std::size_t delivered, std::size_t unread, double spent_s,
                                 const std::string& state) const {
        const std::string component = remote_.name.substr(0, remote_.name.rfind('.'));
        return fmt::format("{} of {} values sent to {} were delivered, {} of these were not read within "
                           "{:.1f} s: {} is {}{}",
                           delivered, sent, remote_.name, unread, spent_s, component, state,
                           state == "ACTIVE" ? " and does not read the port"
                                             : "; run tandem rtm activate " + component);
    }

    const RemotePort& remote_;
    UntypedOutPort& port_;
    const std::string connection_;
    const double timeout_;
};

} // namespace

int rtm_inject(const RtmClientOptions& client_options, const StreamOptions& options) {
    for (const auto& library : options.types) load_type_library(library);
    interrupted(); // installs the handlers, so that SIGINT ends the connection before this program
    const RtmClient client(client_options, true);
    const CdrJsonConverter converter(client.orb());
    const RemotePort remote_port = find_port(client, options.port);
    const std::string type = require_data_type(remote_port, "DataInPort");
    CORBA::TypeCode_var code = CORBA::TypeCode::_duplicate(find_type_code(type));
    if (CORBA::is_nil(code.in()))
        throw std::runtime_error(
            fmt::format("{} has type {}, which is unknown here; give the component's library with --types",
                        remote_port.name, type));
    UntypedOutPort port("out", type.c_str());
    auto properties = options.properties;
    warn_about_properties(connection_properties(properties));
    properties.insert(properties.end(), {"report_unread=YES", "report_lost=YES"}); // see Receiver
    const PortConnection connection(remote_port, port, properties, "tandem-inject");
    Receiver receiver(remote_port, port, connection.id(), client_options.timeout_s);
    unsigned long sent = 0;
    // Pauses before every value except the first, so that the program ends right after the last one. Without a rate,
    // waits until the previous value was read, because an InPort's buffer holds only a few.
    auto send = [&](const std::string& text) {
        if (sent > 0 && options.rate > 0)
            std::this_thread::sleep_for(std::chrono::duration<double>(1 / options.rate));
        else if (sent > 0)
            receiver.wait_until_read(sent);
        port.send(encode_sample(converter, code.in(), text, port.is_little_endian()), remote_port.name);
        ++sent;
    };
    const unsigned long rounds = options.count == 0 ? 1 : options.count;
    // Checks all values before sending, so that the component receives all or none.
    for (const auto& value : options.values)
        encode_sample(converter, code.in(), value == "-" ? "{}" : value, true);
    for (unsigned long round = 0; round < rounds && !interrupted(); ++round)
        for (const auto& value : options.values) {
            if (value != "-") {
                send(value);
                continue;
            }
            // Encodes lines as they arrive, so an error ends the command after earlier lines were sent. Further rounds
            // find standard input at its end.
            for (std::string line; !interrupted() && std::getline(std::cin, line);)
                if (!line.empty()) send(line);
        }
    const bool read = sent > 0 && receiver.wait_until_read(sent);
    if (client_options.json)
        print_json({{"port", remote_port.name}, {"type", type}, {"sent", sent}, {"read", read}});
    else
        print_text(fmt::format("{}: {} value{} {}\n", remote_port.name, sent, sent == 1 ? "" : "s",
                               read ? "sent and read"
                                    : "delivered; its host does not report whether they were read"));
    return 0;
}

} // namespace tandem::command
