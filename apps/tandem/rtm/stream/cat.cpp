// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/rtm/stream/cdr_json.hpp"
#include "apps/tandem/rtm/stream/type_codes.hpp"
#include "apps/tandem/rtm/stream/untyped_ports.hpp"

#include <cstdio>
#include <fmt/format.h>

namespace tandem::command {
namespace {

Json shown(CORBA::TypeCode_ptr type, const RTC::ByteData& bytes, bool raw) {
    if (raw || CORBA::is_nil(type)) return {{"cdr", hex_dump(bytes)}};
    try {
        return cdr_to_json(type, bytes);
    } catch (const DataConversionError& e) {
        return {{"cdr", hex_dump(bytes)}, {"trouble", e.what()}};
    }
}

} // namespace

int rtm_cat(const RtmClientOptions& client_options, const StreamOptions& options) {
    for (const auto& library : options.types) load_type_library(library);
    interrupted(); // from here on an interruption leaves in order
    const RtmClient client(client_options, true);
    const RemotePort remote_port = find_port(client, options.port);
    const std::string type = data_type(remote_port, "DataOutPort");
    CORBA::TypeCode_var code = CORBA::TypeCode::_duplicate(find_type_code(type));
    if (CORBA::is_nil(code.in()) && !options.raw)
        fmt::print(stderr,
                   "{} carries {}, which is not known here: bytes are shown; --types LIBRARY names the "
                   "component's library\n",
                   remote_port.name, type);
    UntypedInPort port("in", type.c_str());
    const PortConnection connection(remote_port, port, options.properties, "tandem-cat");
    const auto begin = std::chrono::steady_clock::now();
    unsigned long seen = 0;
    while (!interrupted() && (options.count == 0 || seen < options.count)) {
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
        if (options.timeout_s > 0 && spent.count() > options.timeout_s) break;
        RTC::ByteData bytes;
        if (!port.samples().next(bytes, std::chrono::milliseconds(100))) continue;
        ++seen;
        // A line for each, so that others can read along.
        print_text(shown(code.in(), bytes, options.raw).dump(-1, ' ', false, Json::error_handler_t::replace) +
                   "\n");
        std::fflush(stdout);
    }
    if (options.count > 0 && seen < options.count && !interrupted())
        throw std::runtime_error(fmt::format("{} of {} samples came within {} s; is {} active?", seen,
                                             options.count, options.timeout_s,
                                             remote_port.name.substr(0, remote_port.name.rfind('.'))));
    return 0;
}

} // namespace tandem::command
