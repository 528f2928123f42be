// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/service/mirror_provided_port.hpp"

#include "proxy/adaptor/archive/cdr_archive.hpp"
#include "proxy/adaptor/service/method_check.hpp"

#include <MethodInvokeException.h>

#include <fmt/format.h>

namespace tandem::adaptor {

MirrorProvidedPort::MirrorProvidedPort(link::Port peer, link::Link& link,
                                       std::chrono::milliseconds call_timeout)
    : peer_(std::move(peer)), link_(link), call_timeout_(call_timeout) {}

std::string MirrorProvidedPort::bindMethod(Method* required) {
    const auto signature = method_signature(*required);
    if (!signature)
        return fmt::format(
            "service port '{}': method '{}' has an argument or result that cannot cross the link", peer_.name,
            required->getName());
    // Compared now, once, so that a call need not carry anything but CDR.
    std::string error = check_method(peer_, required->getName(), *signature);
    if (error.empty()) signatures_[required->getName()] = *signature;
    return error;
}

ReturnType MirrorProvidedPort::callService(std::string& name, std::vector<opros_params>& arguments,
                                           opros_params& result) {
    const auto bound = signatures_.find(name);
    if (bound == signatures_.end()) return OPROS_UNSUPPORTED_METHOD; // it was never connected
    std::vector<std::byte> bytes;
    wire::CdrWriter writer(bytes);
    CdrOarchive archive(writer);
    for (auto& argument : arguments) argument.encode(archive);
    const auto reply = link_.call({peer_.name, name, bound->second, bytes}, call_timeout_);
    // OPRoS stubs return the result itself, so a failure can only be an exception. The host leaves the
    // component ACTIVE after it: the next call may succeed.
    if (reply.status != link::CallStatus::ok)
        throw MethodInvokeException(
            fmt::format("service '{}.{}': {}", peer_.name, name, describe_failure(reply, call_timeout_)));
    CdrIarchive results{wire::CdrReader(reply.bytes)};
    result.decode(results);
    return OPROS_SUCCESS;
}

} // namespace tandem::adaptor
