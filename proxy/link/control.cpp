// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/control.hpp"

#include "proxy/link/error.hpp"
#include "proxy/wire/cdr.hpp"

namespace tandem::link::control {

std::vector<std::byte> encode(const Binding& binding) {
    std::vector<std::byte> bytes;
    wire::CdrWriter out(bytes);
    out.put_string(binding.port);
    out.put(static_cast<std::uint32_t>(binding.operations.size()));
    for (const auto& operation : binding.operations) {
        out.put_string(operation.name);
        out.put_string(operation.signature);
    }
    return bytes;
}

Binding decode_binding(std::span<const std::byte> bytes) {
    wire::CdrReader in(bytes);
    Binding binding;
    binding.port = in.get_string();
    binding.operations.resize(in.get_count(8));
    for (auto& operation : binding.operations) {
        operation.name = in.get_string();
        operation.signature = in.get_string();
    }
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
