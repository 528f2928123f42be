// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/protocol/service_exception.hpp"

#include "proxy/wire/cdr.hpp"

namespace tandem::link {

Reply make_exception_reply(const ServiceException& exception) {
    Reply reply{CallStatus::user_exception, {}};
    wire::CdrWriter out(reply.bytes);
    out.put_string(exception.id);
    out.put_string(exception.text);
    out.put_block(exception.fields.data(), exception.fields.size(), 8);
    return reply;
}

Reply refuse_results(std::string_view text) {
    return make_exception_reply({std::string(refused_results_id), std::string(text), {}});
}

ServiceException decode_service_exception(std::span<const std::byte> bytes) {
    wire::CdrReader in(bytes);
    ServiceException exception;
    exception.id = in.get_string();
    exception.text = in.get_string();
    if (!in.align(8)) return {"", "the peer's exception is damaged", {}};
    const auto fields = bytes.subspan(in.position());
    exception.fields.assign(fields.begin(), fields.end());
    return exception;
}

std::string system_exception_id(CallStatus status) {
    const char* name = "UNKNOWN";
    switch (status) {
    case CallStatus::timeout:
        name = "TIMEOUT";
        break;
    case CallStatus::not_ready:
        name = "TRANSIENT";
        break;
    case CallStatus::peer_died:
    case CallStatus::shut_down:
        name = "COMM_FAILURE";
        break;
    case CallStatus::overload:
        name = "NO_RESOURCES";
        break;
    case CallStatus::no_such_operation:
        name = "BAD_OPERATION";
        break;
    case CallStatus::cancelled:
        name = "NO_RESPONSE";
        break;
    case CallStatus::bad_arguments:
        name = "BAD_PARAM";
        break;
    default:
        break;
    }
    return std::string("IDL:omg.org/CORBA/") + name + ":1.0";
}

} // namespace tandem::link
