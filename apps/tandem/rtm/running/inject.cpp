// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/rtm/running/sample.hpp"
#include "apps/tandem/rtm/running/stream.hpp"
#include "apps/tandem/rtm/running/type_codes.hpp"
#include "apps/tandem/text.hpp"

#include <fmt/format.h>
#include <iostream>
#include <thread>

namespace tandem::command {
namespace {

// What is no JSON is taken as a string: `hello` need not be quoted.
Json parsed(const std::string& text) {
    const Json value = Json::parse(text, nullptr, false);
    return value.is_discarded() ? Json(text) : value;
}

RTC::ByteData message(CORBA::TypeCode_ptr type, const std::string& text, bool little_endian) {
    try {
        return sample_bytes(type, parsed(text), little_endian);
    } catch (const NoSuchValue& e) {
        throw std::runtime_error("`" + text + "`: " + e.what());
    }
}

} // namespace

int rtm_inject(const PeerOptions& options, const StreamOptions& what) {
    for (const auto& library : what.types) load_types(library);
    interrupted();
    const Peers peers(options, true);
    const Port theirs = find_port(peers, what.port);
    const std::string type = data_type(theirs, "DataInPort");
    CORBA::TypeCode_var code = CORBA::TypeCode::_duplicate(type_code(type));
    if (CORBA::is_nil(code.in()))
        throw std::runtime_error(
            fmt::format("{} carries {}, which is not known here; name the component's library with --types",
                        theirs.name, type));
    AnyOut port("out", type.c_str());
    const StreamConnection connection(theirs, port, what.properties, "tandem-inject");
    unsigned long sent = 0;
    auto send = [&](const std::string& text) {
        if (sent > 0 && what.rate > 0)
            std::this_thread::sleep_for(std::chrono::duration<double>(1 / what.rate));
        port.send(message(code.in(), text, port.littleEndian()));
        ++sent;
    };
    const unsigned long rounds = what.count == 0 ? 1 : what.count;
    for (const auto& value : what.values)
        message(code.in(), value == "-" ? "{}" : value, true); // all are sound
    for (unsigned long round = 0; round < rounds && !interrupted(); ++round)
        for (const auto& value : what.values) {
            if (value != "-") {
                send(value);
                continue;
            }
            for (std::string line; !interrupted() && std::getline(std::cin, line);)
                if (!line.empty()) send(line);
        }
    if (options.json) print_json({{"port", theirs.name}, {"type", type}, {"sent", sent}});
    return 0;
}

} // namespace tandem::command
