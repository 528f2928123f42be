// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/control.hpp"

#include "proxy/link/link_error.hpp"
#include "proxy/link/service_operations.hpp"

namespace tandem::link::control {

std::vector<std::byte> encode(const Binding& binding) {
    std::vector<std::byte> bytes;
    wire::CdrWriter out(bytes);
    out.put_string(binding.port);
    put(out, binding.operations);
    return bytes;
}

Binding decode_binding(std::span<const std::byte> bytes) {
    wire::CdrReader in(bytes);
    Binding binding;
    binding.port = in.get_string();
    binding.operations = get_operations(in);
    if (!in.ok()) throw LinkError("a service binding of the partner is damaged");
    return binding;
}

std::vector<std::byte> encode(std::string_view text) {
    std::vector<std::byte> bytes;
    wire::CdrWriter(bytes).put_string(text);
    return bytes;
}

std::string decode_text(std::span<const std::byte> bytes) {
    return std::string(wire::CdrReader(bytes).get_string());
}

} // namespace tandem::link::control
