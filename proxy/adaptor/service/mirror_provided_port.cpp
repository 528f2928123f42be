// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/service/mirror_provided_port.hpp"

#include "proxy/adaptor/archive/cdr_archive.hpp"
#include "proxy/adaptor/archive/pictures.hpp"
#include "proxy/adaptor/service/call_exception.hpp"
#include "proxy/link/protocol/service_exception.hpp"

#include <ServicePortConnector.h>
#include <fmt/format.h>

namespace tandem::adaptor {

using link::CallStatus;
using wire::Direction;

namespace {

CallValue value_of(opros_params& value) {
    return {&value,
            [](const void* at, opros::archive::oarchive& to) {
                static_cast<const opros_params*>(at)->encode(to);
            },
            [](void* at, opros::archive::iarchive& from) { static_cast<opros_params*>(at)->decode(from); }};
}

std::uint64_t id_of(const Method& method) { return reinterpret_cast<std::uintptr_t>(&method); }

} // namespace

MirrorProvidedPort::MirrorProvidedPort(link::Port peer, link::Link& link,
                                       std::chrono::milliseconds call_timeout, PeerNames names)
    : peer_(std::move(peer)), operations_(peer_.operations), link_(link), call_timeout_(call_timeout),
      names_(std::move(names)) {}

/// Compares the types once, so that calls carry only CDR.
std::string MirrorProvidedPort::bindMethod(Method* required) {
    const std::string& name = required->getName();
    Binding binding{name, name, {}, {}, {}, true, ""};
    try {
        binding = make_binding(*required);
    } catch (const wire::SignatureError& error) {
        binding.problem = fmt::format("service port '{}': method '{}' of interface {}: {}", peer_.name, name,
                                      peer_.type, error.what());
    }
    const Binding* known = current_.find(name);
    if (!known || !known->is_same(binding)) {
        bindings_.push_back(std::make_unique<const Binding>(std::move(binding)));
        known = bindings_.back().get();
    }
    current_.add(name, *known, id_of(*required));
    record_refusal(known->problem);
    return known->problem;
}

bool MirrorProvidedPort::Binding::is_same(const Binding& other) const {
    return operation == other.operation && types.signature == other.types.signature &&
           directions == other.directions && waits == other.waits && problem == other.problem &&
           pictures == other.pictures;
}

/// Components of different authors often use different names, so the message lists the operations whose types fit.
std::string MirrorProvidedPort::why_unknown(const std::string& method, const MethodTypes& types) const {
    std::vector<std::string> fitting;
    for (const auto& [name, operation] : operations_)
        if (operation.problem.empty() && fits(types, operation.types)) fitting.push_back(name);
    return fmt::format(
        "the peer's interface has no operation '{}'{}", names_.of(method),
        suggest_names(peer_.name, fitting, method + "=" + (fitting.size() == 1 ? fitting[0] : "OPERATION")));
}

/// Throws SignatureError, one line.
MirrorProvidedPort::Binding MirrorProvidedPort::make_binding(Method& required) const {
    const std::string& name = required.getName();
    Binding binding{name, name, {}, {}, {}, true, ""};
    const std::string& peers_name = names_.of(name);
    const auto* known = operations_.find_for_method(peers_name);
    if (known && !known->problem.empty()) throw wire::SignatureError(known->problem);
    const auto types = describe_method(required, known ? &known->types : nullptr);
    if (known) {
        binding.operation = known->name;
        binding.types = known->types;
    } else if (operations_.empty()) {
        // An interface whose IDL the RTM host does not know: the call itself will show whether the types fit.
        binding.operation = peers_name;
        binding.types = wire::parse_operation(types.operation_signature());
    } else {
        throw wire::SignatureError(why_unknown(name, types));
    }
    binding.directions = match_method(types, binding.types);
    binding.pictures = pictures_in(reply_of(types, binding.directions));
    const bool returns_nothing = binding.types.reply.children.empty();
    binding.waits =
        !binding.types.oneway && !(returns_nothing && required.getCallType() == METHOD_NONBLOCKING);
    binding.request_head = {peer_.name, binding.operation, binding.types.signature};
    return binding;
}

ReturnType MirrorProvidedPort::callService(std::string& name, std::vector<opros_params>& arguments,
                                           opros_params& result) {
    const Binding* bound = current_.find(name);
    if (!bound) return OPROS_UNSUPPORTED_METHOD; // it was never connected
    std::vector<CallValue> values;
    values.reserve(arguments.size());
    for (auto& argument : arguments) values.push_back(value_of(argument));
    return call(*bound, values, value_of(result));
}

ReturnType MirrorProvidedPort::callEncoded(Method& required, const CallValue* arguments, int count,
                                           const CallValue& result) {
    const Binding* bound = current_.find(id_of(required));
    return bound ? call(*bound, {arguments, static_cast<std::size_t>(count)}, result)
                 : OPROS_UNSUPPORTED_METHOD;
}

/// The arguments are encoded after the head of the request, on the stack if they are short.
link::ReplyView MirrorProvidedPort::make_call(const Binding& binding, std::span<const CallValue> arguments,
                                              wire::MessageBuffer& memory) {
    wire::MessageBuffer buffer;
    wire::CdrWriter request(buffer);
    binding.request_head.put(request);
    CdrOarchive archive(request);
    std::size_t i = 0;
    try {
        for (; i < arguments.size(); ++i)
            if (binding.directions[i] != Direction::out) arguments[i].encode_to(archive);
    } catch (const std::exception& error) { // the archive's, or one of the type's own save()
        throw MethodInvokeException(fmt::format("service '{}.{}': argument {} cannot cross: {}", peer_.name,
                                                binding.method, i + 1, error.what()),
                                    link::system_exception_id(CallStatus::bad_arguments));
    }
    if (binding.waits) return link_.call(request.written(), call_timeout_, memory);
    return copy_to(memory, link_.send(*link::decode_request(request.written()), call_timeout_));
}

MethodInvokeException MirrorProvidedPort::refused_results(const Binding& binding,
                                                          std::string_view why) const {
    return {fmt::format("service '{}.{}': the call has run, and its result cannot cross: {}", peer_.name,
                        binding.method, why),
            std::string(link::refused_results_id)};
}

ReturnType MirrorProvidedPort::call(const Binding& binding, std::span<const CallValue> arguments,
                                    const CallValue& result) {
    if (!binding.problem.empty()) [[unlikely]]
        throw MethodInvokeException(binding.problem,
                                    link::system_exception_id(CallStatus::no_such_operation));
    if (arguments.size() != binding.directions.size()) return OPROS_BAD_INPUT_PARAMETER;
    wire::MessageBuffer memory;
    const auto reply = make_call(binding, arguments, memory);
    // OPRoS stubs return the result itself, so a failure can only be an exception. The host leaves the component ACTIVE,
    // because the next call may succeed.
    if (reply.status != CallStatus::ok)
        throw make_exception(peer_.name + "." + binding.method, binding.types, reply.copy(), call_timeout_);
    if (!binding.waits) return OPROS_SUCCESS;
    if (binding.pictures) [[unlikely]]
        if (const auto why =
                picture_error(*binding.pictures, wire::CdrReader(reply.bytes), PictureBytes::exact);
            !why.empty())
            throw refused_results(binding, why);
    CdrIarchive results{wire::CdrReader(reply.bytes)};
    try {
        result.decode_from(results);
        for (std::size_t i = 0; i < arguments.size(); ++i)
            if (binding.directions[i] != Direction::in) arguments[i].decode_from(results);
    } catch (const std::exception& error) { // the archive's, or one of the type's own load()
        throw refused_results(binding, error.what());
    }
    return OPROS_SUCCESS;
}

} // namespace tandem::adaptor
