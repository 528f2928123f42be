// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/share/shared_required_port.hpp"

#include "host/log/log.hpp"
#include "proxy/link/protocol/service_exception.hpp"

#include <MethodInvokeException.h>

#include <fmt/format.h>

namespace tandem::adaptor {
namespace {

// Limits the memory that a peer can use by sending ever new interfaces.
constexpr std::size_t max_interfaces = 64;

} // namespace

void SharedRequiredPort::bind(const link::control::ServiceBinding& binding) {
    const std::lock_guard lock(mutex_);
    if (!mirrors_.empty() && (operations_ == binding.operations || mirrors_.size() == max_interfaces)) return;
    operations_ = binding.operations;
    link::Port port = port_;
    port.operations = binding.operations;
    mirrors_.push_back(std::make_unique<MirrorProvidedPort>(std::move(port), link_, call_timeout_));
    for (Method* method : methods_)
        if (const auto refusal = mirrors_.back()->bindMethod(method); !refusal.empty())
            log::warn("{}; the other methods can be called", refusal);
    current_ = mirrors_.back().get();
}

std::string SharedRequiredPort::bindMethod(Method* required) {
    const std::lock_guard lock(mutex_);
    methods_.push_back(required);
    return "";
}

ReturnType SharedRequiredPort::callService(std::string& name, std::vector<opros_params>& arguments,
                                           opros_params& result) {
    return mirror(name).callService(name, arguments, result);
}

ReturnType SharedRequiredPort::callEncoded(Method& required, const CallValue* arguments, int count,
                                           const CallValue& result) {
    return mirror(required.getName()).callEncoded(required, arguments, count, result);
}

MirrorProvidedPort& SharedRequiredPort::mirror(const std::string& name) {
    if (auto* mirror = current_.load()) return *mirror;
    throw MethodInvokeException(
        fmt::format("service '{}.{}': not ready: the RTM side has not shown this port yet", port_.name, name),
        link::system_exception_id(link::CallStatus::not_ready));
}

} // namespace tandem::adaptor
