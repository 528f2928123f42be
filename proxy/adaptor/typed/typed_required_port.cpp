// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/typed/typed_required_port.hpp"

#include "host/log/log.hpp"
#include "proxy/adaptor/typed/method_type.hpp"
#include "proxy/link/protocol/service_exception.hpp"
#include "proxy/wire/signature_match.hpp"

#include <MethodInvokeException.h>
#include <ProvidedMethodInterface.h>
#include <RequiredMethodInterface.h>
#include <archive/opros_binary_iarchive.h>
#include <archive/opros_binary_oarchive.h>

#include <fmt/format.h>

#include <mutex>
#include <shared_mutex>
#include <sstream>

namespace tandem::adaptor {
namespace {

using link::CallStatus;
using link::Reply;

} // namespace

/// One operation: the required method that the engine connects with the provided one.
class TypedRequiredPort::Operation final : public RequiredMethodInterface {
  public:
    Operation(TypedRequiredPort& port, const std::string& name, const link::KnownOperation& known)
        : RequiredMethodInterface(name), operation(known.name), types(known.types),
          id(link::operation_id(known.name, known.types.signature)), port_(port) {
        for (const auto& argument : types.arguments) arguments_.push_back(find_value_type(argument.type));
        result_ = types.result ? find_value_type(*types.result) : nullptr;
        return_type_ = result_ ? result_->name : "void";
    }
    /// Empty, or why no call of it can cross.
    std::string problem() const {
        for (std::size_t i = 0; i < arguments_.size(); ++i)
            if (!arguments_[i] || types.arguments[i].direction != wire::Direction::in)
                return fmt::format("no type stands for argument {} of '{}'", i + 1, types.signature);
        return types.result && !result_
                   ? fmt::format("no type stands for the result of '{}'", types.signature)
                   : "";
    }

    const std::string operation;
    const wire::Operation types;
    const std::uint64_t id;

    // The engine's.
    std::string& getReturnType() override { return return_type_; }
    int getArity() override { return static_cast<int>(arguments_.size()); }
    int getCallType() override { return METHOD_BLOCKING; }
    ReturnType Connect(Method* peer) override;
    ReturnType Connect(ServicePortConnector*) override { return OPROS_UNSUPPORTED_METHOD; }
    /// Waits for calls that are being served: the method may be destroyed after this function.
    ReturnType Disconnect() override {
        const std::unique_lock lock(mutex_);
        callee_ = nullptr;
        return OPROS_SUCCESS;
    }

    bool is_connected() const {
        const std::shared_lock lock(mutex_);
        return callee_ != nullptr;
    }
    link::ReplyView invoke(std::span<const std::byte> arguments, wire::MessageBuffer& memory);

  private:
    std::string why_refused(Method& method);
    link::ReplyView call(std::span<const std::byte> arguments, wire::MessageBuffer& memory);

    TypedRequiredPort& port_;
    std::vector<const ValueType*> arguments_;
    const ValueType* result_ = nullptr; ///< nullptr for void
    std::string return_type_;
    mutable std::shared_mutex
        mutex_; ///< exclusive to connect, shared to serve: no call runs in a method that is being removed
    ProvidedMethodInterface* callee_ = nullptr;
};

/// Checks only what a method reveals; the first call shows the types of its arguments.
std::string TypedRequiredPort::Operation::why_refused(Method& method) {
    if (method.getArity() != getArity())
        return fmt::format("it has {} arguments, the peer's operation '{}' has {}", method.getArity(),
                           types.signature, getArity());
    const auto* returned = find_value_type(method.getReturnType());
    const bool fits =
        result_ ? returned && is_assignable(returned->type, result_->type) : method.getReturnType() == "void";
    return fits ? ""
                : fmt::format("its result is {}, the peer's operation is '{}'", method.getReturnType(),
                              types.signature);
}

ReturnType TypedRequiredPort::Operation::Connect(Method* peer) {
    if (!peer) return OPROS_BAD_INPUT_PARAMETER;
    if (const auto why = why_refused(*peer); !why.empty()) {
        const std::string refusal = fmt::format("service port '{}': method '{}' is not called: {}",
                                                port_.port_, peer->getName(), why);
        log::error("{}", refusal);
        port_.record_refusal(refusal);
        return OPROS_BAD_INPUT_PARAMETER;
    }
    {
        const std::unique_lock lock(mutex_);
        callee_ = static_cast<ProvidedMethodInterface*>(peer); // as the engine's own required methods do
        if (result_) result_ = find_value_type(peer->getReturnType());
    }
    port_.bound_();
    return OPROS_SUCCESS;
}

link::ReplyView TypedRequiredPort::Operation::invoke(std::span<const std::byte> arguments,
                                                     wire::MessageBuffer& memory) {
    const auto failure = [&](CallStatus status, std::string_view text) {
        return copy_to(memory, Reply::failure(status, text));
    };
    const std::shared_lock lock(mutex_);
    if (!callee_)
        return failure(
            CallStatus::not_ready,
            fmt::format("not ready: no OPRoS component is connected to service port '{}'", port_.port_));
    try {
        return call(arguments, memory);
    } catch (const opros::archive::archive_type_exception&) {
        return failure(
            CallStatus::bad_arguments,
            fmt::format("the OPRoS method has arguments of other types than '{}'", types.signature));
    } catch (MethodInvokeException& error) { // no std::exception in every engine
        return failure(CallStatus::exception, error.getMessage());
    } catch (const std::exception& error) {
        return failure(CallStatus::exception, error.what());
    } catch (...) {
        // A component may throw anything. The caller must learn of it, and the worker thread must survive it.
        return failure(CallStatus::exception, "the OPRoS method threw something other than a std::exception");
    }
}

/// Uses the archives that every engine has. They name the type of each value, so a method with other types cannot read it.
link::ReplyView TypedRequiredPort::Operation::call(std::span<const std::byte> arguments,
                                                   wire::MessageBuffer& memory) {
    std::stringstream request, reply;
    {
        opros::archive::binary_oarchive archive(&request);
        wire::CdrReader in(arguments);
        for (const auto* type : arguments_) type->save(in, archive);
    }
    opros::archive::binary_iarchive from(&request);
    opros::archive::binary_oarchive to(&reply);
    const ReturnType code = callee_->call(from, to);
    if (code != OPROS_SUCCESS)
        return copy_to(
            memory, Reply::failure(CallStatus::exception, fmt::format("the OPRoS method returned {}", code)));
    wire::CdrWriter results(memory);
    try {
        opros::archive::binary_iarchive archive(&reply);
        if (result_) result_->load(archive, results);
    } catch (const std::exception& error) {
        return copy_to(memory, link::refuse_results(fmt::format(
                                   "the call has run, and its result cannot cross: {}", error.what())));
    }
    return {CallStatus::ok, results.written()};
}

TypedRequiredPort::TypedRequiredPort(const link::Port& peer, std::function<void()> bound,
                                     const PeerNames& names)
    : port_(peer.name), bound_(std::move(bound)) {
    const link::OperationTable table(peer.operations);
    if (table.empty())
        log::error("service port '{}' calls nothing: the peer does not know the IDL of interface {}, and the "
                   "methods of this engine do not tell their types: set property 'operations.{}'",
                   peer.name, peer.type, peer.name);
    for (const auto& [name, known] : table) {
        const std::string own = names_of_methods(name, names).front();
        auto operation = std::make_unique<Operation>(*this, own, known);
        const std::string problem = known.problem.empty() ? operation->problem() : known.problem;
        if (problem.empty()) {
            operations_[name] = operation.get();
            addMethod(own, operation.release());
        } else {
            log::error("service port '{}': operation '{}' cannot be called in this engine: {}", peer.name,
                       name, problem);
        }
    }
}

std::vector<link::ServiceOperation> TypedRequiredPort::operations() const {
    std::vector<link::ServiceOperation> operations;
    for (const auto& [name, operation] : operations_)
        if (operation->is_connected()) operations.push_back({name, operation->types.signature});
    return operations;
}

std::optional<link::ReplyView> TypedRequiredPort::serve_known(const link::KnownRequest& request,
                                                              wire::MessageBuffer& memory) {
    for (const auto& [name, operation] : operations_)
        if (operation->id == request.id.operation) return operation->invoke(request.arguments, memory);
    return std::nullopt;
}

Reply TypedRequiredPort::serve(const link::Request& request) {
    const auto found = operations_.find(request.operation);
    if (found == operations_.end())
        return Reply::failure(CallStatus::no_such_operation, "the OPRoS engine cannot call that operation");
    // The peer has the signature from this side or from the same table, but it is another process.
    if (found->second->types.signature != request.signature)
        return Reply::failure(CallStatus::bad_arguments,
                              fmt::format("the operation has signature '{}', not '{}'",
                                          found->second->types.signature, request.signature));
    wire::MessageBuffer memory;
    return found->second->invoke(request.arguments, memory).copy();
}

} // namespace tandem::adaptor
