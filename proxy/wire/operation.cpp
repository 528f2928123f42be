// SPDX-License-Identifier: Apache-2.0
#include "proxy/wire/operation.hpp"

#include "proxy/wire/type_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace tandem::wire {
namespace {

// Limits for signatures that another process wrote.
constexpr std::size_t max_arguments = 256, max_exceptions = 64, max_fields = 256;

constexpr std::string_view oneway_clause = " oneway", raises_clause = " raises";

class OperationParser {
  public:
    explicit OperationParser(std::string_view text) : text_(text) {}

    Operation parse() {
        Operation operation;
        while (!at_end() && next() != ':') {
            if (operation.arguments.size() == max_arguments) fail("it has more than 256 arguments");
            const Direction direction = parse_direction();
            operation.arguments.push_back({direction, parse_next_type(text_, position_)});
        }
        expect(':', "expected 'arguments:result'");
        if (!at_end() && next() != ' ') operation.result = parse_next_type(text_, position_);
        if (skip(oneway_clause)) operation.oneway = true;
        if (skip(raises_clause)) parse_exceptions(operation.exceptions);
        if (!at_end()) fail("expected its end");
        return operation;
    }

  private:
    Direction parse_direction() {
        if (skip(">")) return Direction::out;
        return skip("&") ? Direction::inout : Direction::in;
    }

    void parse_exceptions(std::vector<ExceptionType>& exceptions) {
        do {
            if (exceptions.size() == max_exceptions) fail("it raises more than 64 exceptions");
            exceptions.push_back(parse_exception());
        } while (!at_end());
    }

    // ` ID({name}T{name}T)`
    ExceptionType parse_exception() {
        expect(' ', "expected an exception");
        const auto end = text_.find('(', position_);
        if (end == std::string_view::npos) fail("'(' is missing");
        ExceptionType exception{std::string(text_.substr(position_, end - position_)), {}};
        position_ = end + 1;
        while (!at_end() && next() != ')') {
            if (exception.fields.children.size() == max_fields) fail("an exception has more than 256 fields");
            exception.fields.children.push_back(parse_next_type(text_, position_));
        }
        expect(')', "')' is missing");
        return exception;
    }

    bool at_end() const { return position_ == text_.size(); }
    char next() const { return text_[position_]; }
    bool skip(std::string_view word) {
        if (!text_.substr(position_).starts_with(word)) return false;
        position_ += word.size();
        return true;
    }
    void expect(char what, const char* message) {
        if (at_end() || next() != what) fail(message);
        ++position_;
    }
    [[noreturn]] void fail(std::string_view what) const {
        throw SignatureError(
            fmt::format("operation signature '{}': {} at character {}", text_, what, position_));
    }

    std::string_view text_;
    std::size_t position_ = 0;
};

const char* prefix(Direction direction) {
    return direction == Direction::in ? "" : direction == Direction::out ? ">" : "&";
}

/// Computes the members that depend on the others.
void complete(Operation& operation) {
    if (operation.result) operation.reply.children.push_back(*operation.result);
    for (const auto& [direction, type] : operation.arguments) {
        operation.signature += prefix(direction) + type_signature(type);
        if (direction != Direction::out) operation.request.children.push_back(type);
        if (direction != Direction::in) operation.reply.children.push_back(type);
    }
    operation.signature += ":" + (operation.result ? type_signature(*operation.result) : "");
    operation.plain_request = is_plain(operation.request);
    operation.max_request_bytes = fixed_bytes(operation.request).value_or(SIZE_MAX);
    operation.plain_reply = is_plain(operation.reply);
}

} // namespace

const ExceptionType* Operation::find_exception(std::string_view id) const {
    const auto found = std::find_if(exceptions.begin(), exceptions.end(),
                                    [&](const auto& exception) { return exception.id == id; });
    return found == exceptions.end() ? nullptr : &*found;
}

Operation parse_operation(std::string_view signature) {
    Operation operation = OperationParser(signature).parse();
    complete(operation);
    return operation;
}

std::string first_unsupported(const Operation& operation) {
    for (std::size_t i = 0; i < operation.arguments.size(); ++i) {
        const Type& type = operation.arguments[i].type;
        const auto reason = first_unsupported(type);
        if (!reason.empty() && type.kind == Kind::unsupported) return "argument: " + reason;
        if (!reason.empty()) return fmt::format("argument '{}': {}", type.name, reason);
    }
    if (operation.result)
        if (const auto reason = first_unsupported(*operation.result); !reason.empty())
            return "its result: " + reason;
    for (const auto& exception : operation.exceptions)
        if (const auto reason = first_unsupported(exception.fields); !reason.empty())
            return fmt::format("exception {}: {}", exception.id, reason);
    return "";
}

std::string type_signature(const Type& type) { return to_signature(Type{Kind::structure, 0, {type}}); }

} // namespace tandem::wire
