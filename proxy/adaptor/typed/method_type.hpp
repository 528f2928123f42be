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

/// An operation of the peer, as the methods that stand for it call it. [any-thread]
class RemoteOperation {
  public:
    virtual ~RemoteOperation() = default;
    /// Begins a request: the arguments follow, in CDR.
    virtual void begin(wire::CdrWriter& request) const = 0;
    /// Sends it and waits for the reply, whose bytes are valid as long as `memory`. Throws MethodInvokeException, one line,
    /// for every reply but an ok.
    virtual std::span<const std::byte> call(std::span<const std::byte> request,
                                            wire::MessageBuffer& memory) const = 0;
};

/// A provided method of known C++ types that calls an operation; its port owns it.
class TypedMethod {
  public:
    virtual ~TypedMethod() = default;
    /// The method for a ProvidedServicePort, which owns it and calls this object.
    virtual Method* make_method(const std::string& name) = 0;
};

/// The C++ types of a method.
class MethodType {
  public:
    virtual ~MethodType() = default;
    const std::vector<wire::Type> arguments;
    const std::optional<wire::Type> result; ///< none for void

    /// The operation must outlive it.
    virtual std::unique_ptr<TypedMethod> make(const RemoteOperation& operation) const = 0;

  protected:
    MethodType(std::vector<wire::Type> argument_types, std::optional<wire::Type> result_type)
        : arguments(std::move(argument_types)), result(std::move(result_type)) {}
};

template <class R, class... P>
class TypedMethodOf final : public TypedMethod {
  public:
    explicit TypedMethodOf(const RemoteOperation& operation) : operation_(operation) {}
    Method* make_method(const std::string& name) override {
        return makeProvidedMethod(&TypedMethodOf::call, this, name.c_str(), METHOD_BLOCKING);
    }

  private:
    R call(P... arguments) {
        wire::MessageBuffer buffer, memory;
        wire::CdrWriter request(buffer);
        operation_.begin(request);
        (Codec<P>::encode(arguments, request), ...);
        wire::CdrReader reply(operation_.call(request.written(), memory));
        if constexpr (!std::is_void_v<R>) {
            R result{};
            Codec<R>::decode(result, reply);
            if (!reply.ok()) throw MethodInvokeException("the result does not decode");
            return result;
        }
    }

    const RemoteOperation& operation_;
};

template <class R, class... P>
class MethodTypeOf final : public MethodType {
  public:
    MethodTypeOf() : MethodType({wire_type<P>()...}, result_type()) {}
    std::unique_ptr<TypedMethod> make(const RemoteOperation& operation) const override {
        return std::make_unique<TypedMethodOf<R, P...>>(operation);
    }

  private:
    static std::optional<wire::Type> result_type() {
        if constexpr (std::is_void_v<R>)
            return std::nullopt;
        else
            return wire_type<R>();
    }
};

using MethodTypes = std::vector<std::unique_ptr<const MethodType>>;

/// Methods with the same arguments and each of these results.
template <class... R>
struct WithResults {
    template <class... P>
    static void add(MethodTypes& types) {
        (types.push_back(std::make_unique<const MethodTypeOf<R, P...>>()), ...);
    }
};

/// The method type that stands for an operation whose arguments are all `in`; nullptr if there is none.
const MethodType* find_method_type(const wire::Operation& operation);

/// What methods that stand for the peer's operation are called: `names` says so, or they have its name; an attribute's
/// `_get_x` is `get_x` and `getX`. The first one is the usual one.
std::vector<std::string> names_of_methods(const std::string& operation, const PeerNames& names);

// In files of their own, for the time that they take to compile.
void add_methods_of_one_argument(MethodTypes& types);
void add_methods_of_two_arguments(MethodTypes& types);
/// Those of the user's own header, after all others.
void add_users_methods(MethodTypes& types);

} // namespace tandem::adaptor
