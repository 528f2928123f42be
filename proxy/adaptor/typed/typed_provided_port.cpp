// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/typed/typed_provided_port.hpp"

#include "host/log/log.hpp"
#include "proxy/adaptor/service/call_failure.hpp"
#include "proxy/wire/signature_match.hpp"

#include <fmt/format.h>

namespace tandem::adaptor {

using link::CallStatus;

/// One operation, and how it is called.
class TypedProvidedPort::Operation final : public RemoteOperation {
  public:
    Operation(const TypedProvidedPort& port, const link::Port& peer, const link::KnownOperation& known)
        : types(known.types), port_(port), service_(peer.name + "." + known.name),
          head_(peer.name, known.name, known.types.signature) {}

    const wire::Operation types;

    void begin(wire::CdrWriter& request) const override { head_.put(request); }
    std::span<const std::byte> call(std::span<const std::byte> request,
                                    wire::MessageBuffer& memory) const override {
        if (types.oneway) {
            send(request);
            return {};
        }
        const auto reply = port_.link_.call(request, port_.call_timeout_, memory);
        check(reply);
        return reply.bytes;
    }
    /// Does not wait for the call.
    void send(std::span<const std::byte> request) const {
        const auto reply = port_.link_.send(*link::decode_request(request), port_.call_timeout_);
        check({reply.status, reply.bytes});
    }

  private:
    // Stubs return the result itself, so a failure can only be an exception.
    void check(const link::ReplyView& reply) const {
        if (reply.status != CallStatus::ok)
            throw MethodInvokeException(fmt::format("service '{}': {}", service_,
                                                    describe_failure(reply.copy(), port_.call_timeout_)));
    }

    const TypedProvidedPort& port_;
    const std::string service_;
    const link::RequestHead head_;
};

TypedProvidedPort::TypedProvidedPort(const link::Port& peer, link::Link& link,
                                     std::chrono::milliseconds call_timeout, const PeerNames& names)
    : link_(link), call_timeout_(call_timeout) {
    const link::OperationTable table(peer.operations);
    if (table.empty())
        log::error("service port '{}' cannot be called: the peer does not know the IDL of interface {}, and "
                   "the methods of this engine do not tell their types: set property 'operations.{}'",
                   peer.name, peer.type, peer.name);
    for (const auto& [name, known] : table) add(peer, known, names);
}

void TypedProvidedPort::add(const link::Port& peer, const link::KnownOperation& known,
                            const PeerNames& names) {
    const auto* type = known.problem.empty() ? find_method_type(known.types) : nullptr;
    for (const auto& name : names_of_methods(known.name, names)) {
        if (known.problem.empty()) operations_[name] = std::make_unique<Operation>(*this, peer, known);
        if (type) addMethod(name, type->make(*operations_[name], name));
    }
    if (!type)
        log::error(
            "service port '{}' has no method for operation '{}' in this engine: {}", peer.name, known.name,
            known.problem.empty() ? fmt::format("no method type stands for '{}'", known.types.signature)
                                  : known.problem);
}

ReturnType TypedProvidedPort::callService(std::string& name, std::vector<opros_params>& arguments,
                                          opros_params& result) {
    const auto found = operations_.find(name);
    if (found == operations_.end()) return OPROS_UNSUPPORTED_METHOD;
    const Operation& operation = *found->second;
    if (operation.types.arguments.size() != arguments.size()) return OPROS_BAD_INPUT_PARAMETER;
    wire::MessageBuffer buffer, memory;
    wire::CdrWriter request(buffer);
    operation.begin(request);
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const auto* type = find_value_type(arguments[i].type());
        const auto& wanted = operation.types.arguments[i];
        if (!type || wanted.direction != wire::Direction::in || !is_assignable(type->type, wanted.type))
            return OPROS_BAD_INPUT_PARAMETER;
        try {
            if (!type->encode_param(arguments[i], request)) return OPROS_BAD_INPUT_PARAMETER;
        } catch (const RefusedText& error) {
            throw MethodInvokeException(fmt::format("argument {} cannot cross: {}", i + 1, error.what()));
        }
    }
    if (!operation.types.result) {
        operation.send(request.written());
        return OPROS_SUCCESS;
    }
    const auto* type = find_value_type(*operation.types.result);
    if (!type) return OPROS_UNSUPPORTED_METHOD;
    wire::CdrReader reply(operation.call(request.written(), memory));
    result = type->decode_param(reply);
    return OPROS_SUCCESS;
}

} // namespace tandem::adaptor
