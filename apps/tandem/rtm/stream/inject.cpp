// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/rtm/stream/cdr_json_converter.hpp"
#include "apps/tandem/rtm/stream/type_codes.hpp"
#include "apps/tandem/rtm/stream/untyped_ports.hpp"

#include <fmt/format.h>
#include <iostream>
#include <thread>

namespace tandem::command {
namespace {

// Text that is not JSON is taken as a string, so that `hello` need not be quoted for JSON and for the shell.
Json parse_value(const std::string& text) {
    const Json value = Json::parse(text, nullptr, false);
    return value.is_discarded() ? Json(text) : value;
}

// The message quotes the value as it was given, since several may be on one command line.
RTC::ByteData encode_sample(const CdrJsonConverter& converter, CORBA::TypeCode_ptr type,
                            const std::string& text, bool little_endian) {
    try {
        return converter.to_cdr(type, parse_value(text), little_endian);
    } catch (const DataConversionError& e) {
        throw std::runtime_error("`" + text + "`: " + e.what());
    }
}

} // namespace

int rtm_inject(const RtmClientOptions& client_options, const StreamOptions& options) {
    for (const auto& library : options.types) load_type_library(library);
    interrupted(); // installs the handlers: SIGINT takes the connection down before this program ends
    const RtmClient client(client_options, true);
    const CdrJsonConverter converter(client.orb());
    const RemotePort remote_port = find_port(client, options.port);
    const std::string type = require_data_type(remote_port, "DataInPort");
    CORBA::TypeCode_var code = CORBA::TypeCode::_duplicate(find_type_code(type));
    if (CORBA::is_nil(code.in()))
        throw std::runtime_error(
            fmt::format("{} carries {}, which is not known here; name the component's library with --types",
                        remote_port.name, type));
    UntypedOutPort port("out", type.c_str());
    const PortConnection connection(remote_port, port, options.properties, "tandem-inject");
    unsigned long sent = 0;
    // The pause is before every value but the first, so that the program ends right after the last one.
    auto send = [&](const std::string& text) {
        if (sent > 0 && options.rate > 0)
            std::this_thread::sleep_for(std::chrono::duration<double>(1 / options.rate));
        port.send(encode_sample(converter, code.in(), text, port.is_little_endian()));
        ++sent;
    };
    const unsigned long rounds = options.count == 0 ? 1 : options.count;
    // All values are checked before the first one is sent: nothing or everything reaches the component.
    for (const auto& value : options.values)
        encode_sample(converter, code.in(), value == "-" ? "{}" : value, true);
    for (unsigned long round = 0; round < rounds && !interrupted(); ++round)
        for (const auto& value : options.values) {
            if (value != "-") {
                send(value);
                continue;
            }
            // Lines are encoded as they come: an error ends the command after those before it have been sent. Further
            // rounds find standard input at its end.
            for (std::string line; !interrupted() && std::getline(std::cin, line);)
                if (!line.empty()) send(line);
        }
    if (client_options.json) print_json({{"port", remote_port.name}, {"type", type}, {"sent", sent}});
    return 0;
}

} // namespace tandem::command
