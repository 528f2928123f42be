// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/service/method_types.hpp"

#include "proxy/adaptor/archive/signature_archive.hpp"
#include "proxy/wire/signature_match.hpp"
#include "proxy/wire/type_text.hpp"

#include <fmt/format.h>

#include <deque>

namespace tandem::adaptor {
namespace {

using wire::Direction;
using wire::SignatureError;
using wire::Type;

/// Has a method load its types from archives that record them.
class Recorder final : public MethodDescription {
  public:
    opros::archive::iarchive& result() override { return result_; }
    opros::archive::iarchive& argument(bool writable) override {
        writable_.push_back(writable);
        return arguments_.emplace_back();
    }
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
    std::deque<SignatureArchive> arguments_; ///< the method has references to them
    std::vector<bool> writable_;
};

std::string text_of(const std::optional<Type>& type) { return type ? type_signature(*type) : "void"; }

/// Throws unless the method's argument can stand for the operation's.
Direction match_argument(const MethodTypes::Argument& method, const wire::Argument& operation,
                         std::size_t number) {
    if (!types_fit(method.type, operation.type))
        throw SignatureError(fmt::format("argument {} is {} here, {} there", number, type_name(method.type),
                                         type_name(operation.type)));
    if (operation.direction != Direction::in && !method.writable)
        throw SignatureError(fmt::format("argument {} is {} there: take it by reference or pointer", number,
                                         operation.direction == Direction::out ? "out" : "inout"));
    return operation.direction;
}

bool results_fit(const std::optional<Type>& method, const std::optional<Type>& operation) {
    return method && operation ? types_fit(*method, *operation) : !method && !operation;
}

/// Whether the method has the operation's inout and out arguments in its result.
bool returns_everything(const MethodTypes& method, const wire::Operation& operation) {
    Type arguments;
    for (const auto& argument : method.arguments) {
        if (argument.writable) return false;
        arguments.children.push_back(argument.type);
    }
    return method.result && operation.reply.children.size() > 1 && types_fit(arguments, operation.request) &&
           types_fit(*method.result, operation.reply);
}

} // namespace

std::string MethodTypes::operation_signature() const {
    std::string text;
    for (const auto& argument : arguments)
        text += (argument.writable ? "&" : "") + type_signature(argument.type);
    return text + ":" + (result ? type_signature(*result) : "");
}

MethodTypes describe_method(Method& method) {
    std::string why = "each type needs save() and load()";
    try {
        Recorder recorder;
        if (method.describe(recorder)) return recorder.types();
    } catch (const std::exception& error) { // by the archive, or by a type's own load()
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
        if (!results_fit(method.result, operation.result))
            throw SignatureError(fmt::format("its result is '{}' here, '{}' there", text_of(method.result),
                                             text_of(operation.result)));
        return directions;
    } catch (const SignatureError& error) {
        throw SignatureError(fmt::format("signature '{}', the peer's operation '{}': {}",
                                         method.operation_signature(), operation.signature, error.what()));
    }
}

} // namespace tandem::adaptor
