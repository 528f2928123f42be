// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/rtm/running/sample.hpp"
#include "apps/tandem/rtm/running/stream.hpp"
#include "apps/tandem/rtm/running/type_codes.hpp"
#include "apps/tandem/text.hpp"

#include <cstdio>
#include <fmt/format.h>

namespace tandem::command {
namespace {

Json shown(CORBA::TypeCode_ptr type, const RTC::ByteData& bytes, bool raw) {
    if (raw || CORBA::is_nil(type)) return {{"cdr", hex(bytes)}};
    try {
        return sample_json(type, bytes);
    } catch (const NoSuchValue& e) {
        return {{"cdr", hex(bytes)}, {"trouble", e.what()}};
    }
}

} // namespace

int rtm_cat(const PeerOptions& options, const StreamOptions& what) {
    for (const auto& library : what.types) load_types(library);
    interrupted(); // from here on an interruption leaves in order
    const Peers peers(options, true);
    const Port theirs = find_port(peers, what.port);
    const std::string type = data_type(theirs, "DataOutPort");
    CORBA::TypeCode_var code = CORBA::TypeCode::_duplicate(type_code(type));
    if (CORBA::is_nil(code.in()) && !what.raw)
        fmt::print(stderr,
                   "{} carries {}, which is not known here: bytes are shown; --types LIBRARY names the "
                   "component's library\n",
                   theirs.name, type);
    AnyIn port("in", type.c_str());
    const StreamConnection connection(theirs, port, what.properties, "tandem-cat");
    const auto begin = std::chrono::steady_clock::now();
    unsigned long seen = 0;
    while (!interrupted() && (what.count == 0 || seen < what.count)) {
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
        if (what.seconds > 0 && spent.count() > what.seconds) break;
        RTC::ByteData bytes;
        if (!port.arrivals().next(bytes, std::chrono::milliseconds(100))) continue;
        ++seen;
        // A line for each, so that others can read along.
        print_text(shown(code.in(), bytes, what.raw).dump(-1, ' ', false, Json::error_handler_t::replace) +
                   "\n");
        std::fflush(stdout);
    }
    if (what.count > 0 && seen < what.count && !interrupted())
        throw std::runtime_error(fmt::format("{} of {} samples came within {} s; is {} active?", seen,
                                             what.count, what.seconds,
                                             theirs.name.substr(0, theirs.name.rfind('.'))));
    return 0;
}

} // namespace tandem::command
