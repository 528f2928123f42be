// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/manage/built_in_service.hpp"

#include <omniORB4/CORBA.h>

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace tandem::interceptor {

using link::CallStatus;
using link::Reply;

namespace {

constexpr std::size_t min_string_bytes = 5; // of a string in CDR: its length and the final NUL

/// Decodes the arguments that the signature describes. Returns nothing if the bytes, which come from another process, do not
/// match it.
std::optional<BuiltInService::Strings> decode(std::string_view arguments, std::span<const std::byte> bytes) {
    wire::CdrReader in(bytes);
    BuiltInService::Strings strings;
    for (; arguments.starts_with('s'); arguments.remove_prefix(1)) strings.emplace_back(in.get_string());
    if (arguments == "as")
        for (auto left = in.get_count(min_string_bytes); left > 0 && in.ok(); --left)
            strings.emplace_back(in.get_string());
    if (!in.ok()) return std::nullopt;
    return strings;
}

void encode(std::string_view result, const BuiltInService::Strings& strings, std::vector<std::byte>& bytes) {
    wire::CdrWriter out(bytes);
    if (result == "as") out.put(static_cast<std::uint32_t>(strings.size()));
    for (const auto& string : strings) out.put_string(string);
}

} // namespace

BuiltInService::BuiltInService(const std::string& name) {
    port_.kind = link::PortKind::service_provided;
    port_.name = port_.type = port_.instance = name;
}

void BuiltInService::add(const std::string& name, const std::string& signature, Operation operation) {
    port_.operations.push_back({name, signature});
    operations_[name] = std::move(operation);
}

Reply BuiltInService::serve(const link::Request& request) const {
    const auto described = std::find_if(port_.operations.begin(), port_.operations.end(),
                                        [&](const auto& each) { return each.name == request.operation; });
    if (described == port_.operations.end())
        return Reply::failure(CallStatus::no_such_operation,
                              fmt::format("{} has no such operation", port_.name));
    const std::string_view signature = described->signature;
    const auto arguments = decode(signature.substr(0, signature.find(':')), request.arguments);
    if (request.signature != signature || !arguments)
        return Reply::failure(CallStatus::bad_arguments,
                              fmt::format("the operation has signature '{}'", described->signature));
    try {
        Reply reply;
        encode(signature.substr(signature.find(':') + 1),
               operations_.find(request.operation)->second(*arguments), reply.bytes);
        return reply;
    } catch (const std::exception& error) {
        return Reply::failure(CallStatus::exception, error.what());
    } catch (const CORBA::Exception& error) { // not a std::exception
        return Reply::failure(
            CallStatus::exception,
            fmt::format("a call of another component or manager failed with {}", error._name()));
    }
}

} // namespace tandem::interceptor
