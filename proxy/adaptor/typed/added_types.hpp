// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/adaptor/typed/method_type.hpp"

#include <string>
#include <utility>
#include <vector>

// Included by a user's own header of types (TANDEM_OPROS_TYPES, docs/real_engines.md). That header defines a Codec for each
// structure, and lists the types of ports and methods in namespace tandem::adaptor, as AddedValues and AddedMethods.
namespace tandem::adaptor {

/// A structure with these members, in the peer's order: a base class of its Codec.
template <class T, auto... Member>
struct StructureCodec {
    static std::string signature() { return "(" + (signature_of(Member) + ...) + ")"; }
    static void encode(const T& value, wire::CdrWriter& out) { (encode_member(value.*Member, out), ...); }
    static void decode(T& value, wire::CdrReader& in) { (decode_member(value.*Member, in), ...); }

  private:
    template <class M>
    static std::string signature_of(M T::*) {
        return Codec<M>::signature();
    }
    template <class M>
    static void encode_member(const M& member, wire::CdrWriter& out) {
        Codec<M>::encode(member, out);
    }
    template <class M>
    static void decode_member(M& member, wire::CdrReader& in) {
        Codec<M>::decode(member, in);
    }
};

/// The types of ports, and of the members of vectors that ports have.
template <class... T>
struct Values {
    static void add_to([[maybe_unused]] ValueTypes& types) {
        (add_value_type<T>(types), ...);
        (add_value_type<std::vector<T>>(types), ...);
    }
};

/// The methods that OPRoS components require, as function types: `int(std::string, Pose)`.
template <class... Function>
struct Methods {
    static void add_to([[maybe_unused]] MethodTypes& types) {
        (add(types, static_cast<Function*>(nullptr)), ...);
    }

  private:
    template <class R, class... P>
    static void add(MethodTypes& types, R (*)(P...)) {
        add_method_type<R, P...>(types);
    }
};

} // namespace tandem::adaptor
