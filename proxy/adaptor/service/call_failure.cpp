// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/service/call_failure.hpp"

#include "proxy/link/protocol/service_exception.hpp"

#include <fmt/format.h>

namespace tandem::adaptor {
namespace {

using link::CallStatus;
using link::Reply;

std::string text_or(const Reply& reply, const char* without) {
    return reply.bytes.empty() ? without : reply.text();
}

} // namespace

std::string describe_failure(const Reply& reply, std::chrono::milliseconds call_timeout) {
    switch (reply.status) {
    case CallStatus::timeout:
        return text_or(reply,
                       fmt::format("no reply within {} ms; AdaptorComp's property 'call_timeout' allows more",
                                   call_timeout.count())
                           .c_str());
    case CallStatus::peer_died:
        return "the peer has gone";
    case CallStatus::overload:
        return text_or(reply, "too many calls are under way");
    case CallStatus::shut_down:
        return "the link is closing";
    case CallStatus::not_ready:
        return text_or(reply, "not ready");
    case CallStatus::no_such_operation:
        return text_or(reply, "the peer has no such operation");
    case CallStatus::bad_arguments:
        return text_or(reply, "the peer cannot read the arguments");
    case CallStatus::cancelled:
        return "the caller has cancelled the call";
    case CallStatus::user_exception:
        return link::decode_service_exception(reply.bytes).text;
    default:
        return text_or(reply, "the peer's component failed");
    }
}

} // namespace tandem::adaptor
