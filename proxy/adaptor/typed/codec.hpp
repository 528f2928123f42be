// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/adaptor/archive/refused_text.hpp"
#include "proxy/adaptor/archive/type_code.hpp"
#include "proxy/wire/cdr.hpp"

#include <archive/opros_archive.h>

#include <string>
#include <type_traits>
#include <vector>

namespace tandem::adaptor {

/// How values of T cross: signature, CDR, and the values in an OPRoS archive. T is a number, bool, std::string, or a
/// std::vector of them or of such vectors. decode() reads bytes that another process wrote: the reader's ok() says whether
/// they were a value.
template <class T>
struct Codec {
    static_assert(std::is_arithmetic_v<T> && !std::is_same_v<T, wchar_t>);
    static std::string signature() { return {code_of<T>()}; }
    static void encode(T value, wire::CdrWriter& out) {
        if constexpr (std::is_same_v<T, bool>)
            out.put_bool(value);
        else
            out.put(value);
    }
    static void decode(T& value, wire::CdrReader& in) {
        if constexpr (std::is_same_v<T, bool>)
            value = in.get_bool();
        else
            value = in.get<T>();
    }
};

template <>
struct Codec<std::string> {
    static std::string signature() { return "s"; }
    /// Throws RefusedText for a NUL within the string, which CORBA's strings cannot hold.
    static void encode(const std::string& value, wire::CdrWriter& out) {
        if (value.find('\0') != std::string::npos) throw RefusedText::with_nul();
        out.put_string(value);
    }
    static void decode(std::string& value, wire::CdrReader& in) { value = in.get_string(); }
};

template <class T>
struct Codec<std::vector<T>> {
    static constexpr bool is_block = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

    static std::string signature() { return "a" + Codec<T>::signature(); }
    static void encode(const std::vector<T>& value, wire::CdrWriter& out) {
        if constexpr (is_block) {
            out.put_sequence(value.data(), value.size());
        } else {
            out.put(static_cast<std::uint32_t>(value.size()));
            for (const auto& element : value) Codec<T>::encode(element, out);
        }
    }
    static void decode(std::vector<T>& value, wire::CdrReader& in) {
        if constexpr (is_block) {
            const auto block = in.get_sequence(sizeof(T), wire::cdr_alignment<T>);
            value.resize(block.size() / sizeof(T));
            wire::copy_block(value.data(), block.data(), block.size());
        } else {
            value.resize(in.get_count(1)); // an element takes at least one byte
            for (std::size_t i = 0; i < value.size(); ++i) {
                T element{}; // a bool element cannot be referenced
                Codec<T>::decode(element, in);
                value[i] = std::move(element);
            }
        }
    }
};

} // namespace tandem::adaptor
