// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/adaptor/names/peer_names.hpp"
#include "proxy/adaptor/typed/value_type.hpp"
#include "proxy/link/protocol/reply.hpp"
#include "proxy/wire/operation.hpp"

#include <MethodInvokeException.h>
#include <ProvidedMethod.h>

#include <memory>
#include <string>
#include <vector>

namespace tandem::adaptor {

/// An operation of the peer, as called by the methods that stand for it. [any-thread]
class RemoteOperation {
  public:
    virtual ~RemoteOperation() = default;

    /// Implements a provided method with these C++ types by a call of the operation. Throws MethodInvokeException, one
    /// line, unless the reply is ok.
    template <class R, class... P>
    R call_method(P... arguments) {
        wire::MessageBuffer buffer, memory;
        wire::CdrWriter request(buffer);
        begin(request);
        try {
            (Codec<P>::encode(arguments, request), ...);
        } catch (const RefusedText& error) {
            throw MethodInvokeException(std::string("an argument cannot cross: ") + error.what());
        }
        wire::CdrReader reply(call(request.written(), memory));
        if constexpr (!std::is_void_v<R>) {
            R result{};
            Codec<R>::decode(result, reply);
            if (!reply.ok()) throw MethodInvokeException("the result does not decode");
            return result;
        }
    }

    /// Begins a request. The arguments follow, in CDR.
    virtual void begin(wire::CdrWriter& request) const = 0;
    /// Sends the request and waits for the reply, whose bytes are valid as long as `memory`. Throws like call_method().
    virtual std::span<const std::byte> call(std::span<const std::byte> request,
                                            wire::MessageBuffer& memory) const = 0;
};

/// The types of a method: those that cross, and a function that creates a method of the C++ types.
struct MethodType {
    std::vector<wire::Type> arguments;
    std::optional<wire::Type> result; ///< none for void
    /// Creates a method for a ProvidedServicePort, which owns it. The operation must outlive it.
    Method* (*make)(RemoteOperation& operation, const std::string& name);
};

using MethodTypes = std::vector<MethodType>;

template <class R>
std::optional<wire::Type> result_type() {
    if constexpr (std::is_void_v<R>)
        return std::nullopt;
    else
        return wire_type<R>();
}

template <class R, class... P>
Method* make_method(RemoteOperation& operation, const std::string& name) {
    const auto function = static_cast<R (RemoteOperation::*)(P...)>(&RemoteOperation::call_method<R, P...>);
    return makeProvidedMethod(function, &operation, name.c_str(), METHOD_BLOCKING);
}

template <class R, class... P>
void add_method_type(MethodTypes& types) {
    types.push_back({{wire_type<P>()...}, result_type<R>(), &make_method<R, P...>});
}

/// Adds methods with the same arguments and each of these results.
template <class... R>
struct WithResults {
    template <class... P>
    static void add(MethodTypes& types) {
        (add_method_type<R, P...>(types), ...);
    }
};

/// Returns the method type for an operation whose arguments are all `in`; nullptr if there is none.
const MethodType* find_method_type(const wire::Operation& operation);

/// Returns the names of the methods that stand for the peer's operation: those in `names`, or its own name; `_get_x` of an
/// attribute is `get_x` and `getX`. The first one is the usual one.
std::vector<std::string> names_of_methods(const std::string& operation, const PeerNames& names);

// In separate files, because of their compile time.
void add_methods_of_one_argument(MethodTypes& types);
void add_methods_of_two_arguments(MethodTypes& types);
/// Adds the methods of the user's header, after all others.
void add_users_methods(MethodTypes& types);

} // namespace tandem::adaptor
