// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/service/method_types.hpp"

#include "proxy/adaptor/archive/signature_archive.hpp"
#include "proxy/adaptor/archive/union_cases.hpp"
#include "proxy/wire/signature_match.hpp"
#include "proxy/wire/type_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <exception>

namespace tandem::adaptor {
namespace {

using wire::Direction;
using wire::SignatureError;
using wire::Type;

/// Has a method load its types from archives that record them.
class Recorder final : public MethodDescription {
  public:
    Recorder() = default;
    /// Passes the values to the archives of the result and of each argument (SignatureArchive).
    Recorder(std::vector<long long> of_result, std::vector<std::vector<long long>> of_arguments)
        : result_(std::move(of_result)), values_(std::move(of_arguments)) {}

    opros::archive::iarchive& result() override { return result_; }
    opros::archive::iarchive& argument(bool writable) override {
        writable_.push_back(writable);
        const std::size_t index = arguments_.size();
        return arguments_.emplace_back(index < values_.size() ? values_[index] : std::vector<long long>());
    }
    const std::vector<bool>& writable() const { return writable_; }
    const std::string& result_signature() const { return result_.signature(); }
    const std::string& argument_signature(std::size_t index) const { return arguments_[index].signature(); }
    MethodTypes types() const {
        MethodTypes types;
        if (!result_.signature().empty()) types.result = recorded_type(result_);
        for (std::size_t i = 0; i < arguments_.size(); ++i)
            types.arguments.push_back({recorded_type(arguments_[i]), writable_[i]});
        return types;
    }

  private:
    static Type recorded_type(const SignatureArchive& archive) {
        const Type message = wire::parse_signature(archive.signature());
        return message.children.size() == 1 ? message.children.front() : message;
    }

    SignatureArchive result_;
    std::vector<std::vector<long long>> values_;
    std::deque<SignatureArchive> arguments_; ///< the method has references to them
    std::vector<bool> writable_;
};

std::string text_of(const std::optional<Type>& type) { return type ? type_signature(*type) : "void"; }

/// Throws if the method's argument cannot represent the operation's.
Direction match_argument(const MethodTypes::Argument& method, const wire::Argument& operation,
                         std::size_t number) {
    if (!is_assignable(method.type, operation.type))
        throw SignatureError(fmt::format("argument {} is {} here, {} there{}", number, type_name(method.type),
                                         type_name(operation.type),
                                         wire::crossing_hint(method.type.kind, operation.type.kind)));
    if (operation.direction != Direction::in && !method.writable)
        throw SignatureError(fmt::format("argument {} is {} there: take it by reference or pointer", number,
                                         operation.direction == Direction::out ? "out" : "inout"));
    return operation.direction;
}

bool is_result_assignable(const std::optional<Type>& method, const std::optional<Type>& operation) {
    return method && operation ? is_assignable(*method, *operation) : !method && !operation;
}

/// Returns whether the method's result contains the operation's inout and out arguments: in a structure with the operation's
/// result, or alone if there is only one.
bool returns_everything(const MethodTypes& method, const wire::Operation& operation) {
    Type arguments;
    for (const auto& argument : method.arguments) {
        if (argument.writable) return false;
        arguments.children.push_back(argument.type);
    }
    const auto& reply = operation.reply.children;
    if (!method.result || !is_assignable(arguments, operation.request)) return false;
    if (reply.size() > 1) return is_assignable(*method.result, operation.reply);
    return reply.size() == 1 && !operation.result && is_assignable(*method.result, reply.front());
}

/// Returns the largest number of cases of any union in the operation; 0 if there is no union.
std::size_t count_cases(const wire::Operation& operation) {
    std::size_t max_cases = operation.result ? count_union_cases(*operation.result) : 0;
    for (const auto& argument : operation.arguments)
        max_cases = std::max(max_cases, count_union_cases(argument.type));
    return max_cases;
}

/// Returns whether the method reads case number `run` of each union of the operation, and all other values.
bool reads_cases(Method& method, const wire::Operation& operation, std::size_t run,
                 std::vector<bool>& writable) {
    std::vector<long long> of_result;
    std::vector<std::vector<long long>> of_arguments;
    std::vector<Type> chosen;
    const auto message_of = [](const Type& type) {
        Type message;
        message.children.push_back(type);
        return message;
    };
    const Type result =
        operation.result ? choose_union_cases(message_of(*operation.result), run, of_result) : Type{};
    for (const auto& argument : operation.arguments)
        chosen.push_back(choose_union_cases(message_of(argument.type), run, of_arguments.emplace_back()));
    Recorder recorder(std::move(of_result), std::move(of_arguments));
    if (!method.describe(recorder)) return false;
    writable = recorder.writable();
    if (writable.size() != chosen.size() || !is_chosen_type(recorder.result_signature(), result))
        return false;
    for (std::size_t i = 0; i < chosen.size(); ++i)
        if (!is_chosen_type(recorder.argument_signature(i), chosen[i])) return false;
    return true;
}

/// Returns the operation's types if the method reads every case of its unions; otherwise, or if there are no unions, nothing.
std::optional<MethodTypes> match_unions(Method& method, const wire::Operation& operation) {
    const std::size_t cases = count_cases(operation);
    if (cases == 0) return std::nullopt;
    std::vector<bool> writable;
    try {
        for (std::size_t run = 0; run < cases; ++run)
            if (!reads_cases(method, operation, run, writable)) return std::nullopt;
    } catch (const std::exception&) { // a type's own load() refuses that case
        return std::nullopt;
    }
    MethodTypes types{{}, operation.result};
    for (std::size_t i = 0; i < operation.arguments.size(); ++i)
        types.arguments.push_back({operation.arguments[i].type, writable[i]});
    return types;
}

} // namespace

std::string MethodTypes::operation_signature() const {
    std::string text;
    for (const auto& argument : arguments)
        text += (argument.writable ? "&" : "") + type_signature(argument.type);
    return text + ":" + (result ? type_signature(*result) : "");
}

MethodTypes describe_method(Method& method, const wire::Operation* expected) {
    if (expected)
        if (auto types = match_unions(method, *expected)) return *types;
    std::string why = "each type needs save() and load()";
    try {
        Recorder recorder;
        if (method.describe(recorder)) return recorder.types();
    } catch (const std::exception& error) { // thrown by the archive or by a type's own load()
        why = error.what();
    }
    throw SignatureError(fmt::format("its types cannot cross the link: {}: {}", method.signature(), why));
}

Directions match_method(const MethodTypes& method, const wire::Operation& operation) {
    if (returns_everything(method, operation)) return Directions(method.arguments.size(), Direction::in);
    try {
        if (method.arguments.size() != operation.arguments.size())
            throw SignatureError(fmt::format("it has {} arguments here, {} there", method.arguments.size(),
                                             operation.arguments.size()));
        Directions directions;
        for (std::size_t i = 0; i < method.arguments.size(); ++i)
            directions.push_back(match_argument(method.arguments[i], operation.arguments[i], i + 1));
        if (!is_result_assignable(method.result, operation.result))
            throw SignatureError(fmt::format("its result is '{}' here, '{}' there", text_of(method.result),
                                             text_of(operation.result)));
        return directions;
    } catch (const SignatureError& error) {
        throw SignatureError(fmt::format("signature '{}', the peer's operation '{}': {}",
                                         method.operation_signature(), operation.signature, error.what()));
    }
}

bool fits(const MethodTypes& method, const wire::Operation& operation) {
    try {
        match_method(method, operation);
        return true;
    } catch (const SignatureError&) {
        return false;
    }
}

wire::Type request_of(const MethodTypes& method, const Directions& directions) {
    Type request;
    for (std::size_t i = 0; i < directions.size(); ++i)
        if (directions[i] != Direction::out) request.children.push_back(method.arguments[i].type);
    return request;
}

wire::Type reply_of(const MethodTypes& method, const Directions& directions) {
    Type reply;
    if (method.result) reply.children.push_back(*method.result);
    for (std::size_t i = 0; i < directions.size(); ++i)
        if (directions[i] != Direction::in) reply.children.push_back(method.arguments[i].type);
    return reply;
}

} // namespace tandem::adaptor
