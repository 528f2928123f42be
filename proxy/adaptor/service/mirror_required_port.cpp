// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/service/mirror_required_port.hpp"

#include "host/log/log.hpp"
#include "proxy/adaptor/archive/cdr_archive.hpp"
#include "proxy/adaptor/archive/pictures.hpp"
#include "proxy/adaptor/service/call_exception.hpp"
#include "proxy/link/protocol/service_exception.hpp"

#include <ProvidedMethodInterface.h>
#include <ProvidedServicePort.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <mutex>

namespace tandem::adaptor {
namespace {

using link::CallStatus;
using link::Reply;
using wire::Direction;

/// The values of one call, read from the request and written to the reply.
class RequestCall final : public EncodedCall {
  public:
    RequestCall(const Directions& directions, std::span<const std::byte> arguments,
                wire::MessageBuffer& results)
        : directions_(directions), arguments_(wire::CdrReader(arguments)), writer_(results),
          results_(writer_) {}
    std::span<const std::byte> written() const { return writer_.written(); }
    /// Returns whether the method has returned: what follows are its results.
    bool has_run() const { return has_run_; }

    opros::archive::iarchive* argument(int index) override {
        return direction(index) == Direction::out ? nullptr : &arguments_;
    }
    opros::archive::oarchive& result() override {
        has_run_ = true;
        return results_;
    }
    opros::archive::oarchive* written_argument(int index) override {
        has_run_ = true;
        return direction(index) == Direction::in ? nullptr : &results_;
    }

  private:
    Direction direction(int index) const { return directions_.at(static_cast<std::size_t>(index)); }

    const Directions& directions_;
    CdrIarchive arguments_;
    wire::CdrWriter writer_;
    CdrOarchive results_;
    bool has_run_ = false;
};

bool is_fitting(Method& method, const wire::Operation& operation) {
    try {
        return fits(describe_method(method, &operation), operation);
    } catch (const wire::SignatureError&) {
        return false;
    }
}

} // namespace

MirrorRequiredPort::MirrorRequiredPort(link::Port peer, std::function<void()> bound, PeerNames names)
    : peer_(std::move(peer)), required_(peer_.operations), bound_(std::move(bound)),
      names_(std::move(names)) {}

/// Waits for calls that are being served: the port that they use may be destroyed after this function.
std::string MirrorRequiredPort::bindProvided(ProvidedServicePort* provided) {
    const std::unique_lock lock(mutex_);
    known_.clear();
    bindings_.clear();
    problems_.clear();
    provided_ = nullptr;
    if (!provided) return "";
    bind_methods(*provided);
    if (!bindings_.empty()) {
        log_missing_operations();
        make_known();
        provided_ = provided;
        bound_();
        return "";
    }
    std::string refusal =
        fmt::format("service port '{}': the connected port provides no operation of interface {}{}",
                    peer_.name, peer_.type, describe_problems());
    record_refusal(refusal);
    return refusal;
}

void MirrorRequiredPort::bind_methods(ProvidedServicePort& provided) {
    for (const auto& [name, operation] : required_)
        problems_[name] =
            operation.problem.empty() ? "the connected port has no such method" : operation.problem;
    for (auto at = provided.getFirst(); at != provided.getEnd(); ++at) bind_method(at->first, *at->second);
    suggest_methods(provided);
}

/// Components of different authors often use different names, so the message lists the methods whose types fit.
void MirrorRequiredPort::suggest_methods(ProvidedServicePort& provided) {
    std::map<std::string, std::vector<std::string>> fitting; // methods, by operation
    for (auto at = provided.getFirst(); at != provided.getEnd(); ++at) {
        const auto& [name, method] = *at;
        if (required_.find_for_method(names_.of(name))) continue;
        for (const auto& [operation, known] : required_)
            if (known.problem.empty() && problems_.contains(operation) && is_fitting(*method, known.types))
                fitting[operation].push_back(name);
    }
    for (const auto& [operation, methods] : fitting)
        problems_[operation] += suggest_names(
            peer_.name, methods, (methods.size() == 1 ? methods[0] : "METHOD") + "=" + operation);
}

/// Ignores methods that the peer does not require, even if their types cannot cross.
void MirrorRequiredPort::bind_method(const std::string& name, Method& method) {
    if (names_.is_of_another(name)) return;
    const std::string& peers_name = names_.of(name);
    const auto* known = required_.find_for_method(peers_name);
    if (!known && !required_.empty()) return;
    const std::string& operation = known ? known->name : peers_name;
    if (known && !known->problem.empty()) return;
    try {
        const auto types = describe_method(method, known ? &known->types : nullptr);
        // If the peer does not know its IDL, the methods are the only description of the operations.
        Binding binding{name,
                        method.provided(),
                        known ? known->types : wire::parse_operation(types.operation_signature()),
                        {},
                        {}};
        binding.directions = match_method(types, binding.types);
        binding.pictures = pictures_in(request_of(types, binding.directions));
        bindings_[operation] = std::move(binding);
        problems_.erase(operation);
    } catch (const wire::SignatureError& error) {
        problems_[operation] = fmt::format("method '{}': {}", name, error.what());
    }
}

/// Describes only a few operations, because an interface may have many.
std::string MirrorRequiredPort::describe_problems() const {
    constexpr std::size_t shown = 3;
    std::vector<std::string> lines;
    for (const auto& [operation, problem] : problems_)
        if (lines.size() < shown) lines.push_back(fmt::format("operation '{}': {}", operation, problem));
    if (problems_.size() > shown) lines.push_back(fmt::format("and {} more", problems_.size() - shown));
    return lines.empty() ? "" : fmt::format(": {}", fmt::join(lines, "; "));
}

void MirrorRequiredPort::make_known() {
    for (const auto& [name, binding] : bindings_)
        known_.emplace_back(link::operation_id(name, binding.types.signature), &binding);
}

void MirrorRequiredPort::log_missing_operations() {
    for (const auto& [operation, problem] : problems_)
        log::warn("service port '{}': operation '{}' of interface {} cannot be called, the others can: {}",
                  peer_.name, operation, peer_.type, problem);
}

std::vector<link::ServiceOperation> MirrorRequiredPort::operations() const {
    const std::shared_lock lock(mutex_);
    std::vector<link::ServiceOperation> operations;
    for (const auto& [name, binding] : bindings_) operations.push_back({name, binding.types.signature});
    return operations;
}

std::optional<link::ReplyView> MirrorRequiredPort::serve_known(const link::KnownRequest& request,
                                                               wire::MessageBuffer& memory) {
    const std::shared_lock lock(mutex_);
    if (provided_)
        for (const auto& [id, binding] : known_)
            if (id == request.id.operation) return invoke(request.arguments, *binding, memory);
    return std::nullopt;
}

Reply MirrorRequiredPort::serve(const link::Request& request) {
    const std::shared_lock lock(mutex_);
    const auto bound = bindings_.find(request.operation);
    if (bound == bindings_.end()) {
        // Also answers for a port whose connection was refused.
        if (const auto problem = problems_.find(request.operation); problem != problems_.end())
            return Reply::failure(CallStatus::no_such_operation, problem->second);
        if (provided_ || !problems_.empty())
            return Reply::failure(CallStatus::no_such_operation, "the OPRoS component has no such method");
    }
    if (!provided_)
        return Reply::failure(
            CallStatus::not_ready,
            fmt::format("not ready: no OPRoS component is connected to service port '{}'", peer_.name));
    // The peer has the signature from this side or from the same table, but it is another process.
    if (bound->second.types.signature != request.signature)
        return Reply::failure(CallStatus::bad_arguments,
                              fmt::format("the method has signature '{}', not '{}'",
                                          bound->second.types.signature, request.signature));
    wire::MessageBuffer memory;
    return invoke(request.arguments, bound->second, memory).copy();
}

link::ReplyView MirrorRequiredPort::invoke(std::span<const std::byte> arguments, const Binding& binding,
                                           wire::MessageBuffer& memory) {
    const auto failure = [&](CallStatus status, std::string_view text) {
        return copy_to(memory, Reply::failure(status, text));
    };
    if (binding.pictures) [[unlikely]]
        if (const auto why =
                picture_error(*binding.pictures, wire::CdrReader(arguments), PictureBytes::exact);
            !why.empty())
            return failure(CallStatus::bad_arguments, why);
    RequestCall call(binding.directions, arguments, memory);
    try {
        const ReturnType code =
            binding.callee ? binding.callee->call(call) : provided_->callService(binding.method, call);
        if (code == OPROS_SUCCESS) return {CallStatus::ok, call.written()};
        return failure(CallStatus::exception, fmt::format("the OPRoS method returned {}", code));
    } catch (const MethodInvokeException& error) {
        return copy_to(memory, make_reply(error, binding.types));
    } catch (const std::exception& error) {
        if (call.has_run())
            return copy_to(memory, link::refuse_results(fmt::format(
                                       "the call has run, and its result cannot cross: {}", error.what())));
        if (dynamic_cast<const opros::archive::archive_type_exception*>(&error) != nullptr)
            return failure(CallStatus::bad_arguments, "the arguments do not decode");
        return failure(CallStatus::exception, error.what());
    } catch (...) {
        // A component may throw anything. The caller must learn of it, and the worker thread must survive it.
        return failure(CallStatus::exception, "the OPRoS method threw something other than a std::exception");
    }
}

} // namespace tandem::adaptor
