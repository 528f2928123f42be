// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/protocol/control.hpp"

#include "proxy/link/protocol/link_error.hpp"
#include "proxy/link/protocol/service_operations.hpp"

namespace tandem::link::control {
namespace {

constexpr std::size_t min_string_bytes = 5; // of a string in CDR: its length and the final NUL

} // namespace

// Each argument is a separate CDR message from another process, so decoding checks every length.

std::vector<std::byte> encode(const ServiceBinding& binding) {
    std::vector<std::byte> bytes;
    wire::CdrWriter out(bytes);
    out.put_string(binding.port);
    put(out, binding.operations);
    return bytes;
}

ServiceBinding decode_service_binding(std::span<const std::byte> bytes) {
    wire::CdrReader in(bytes);
    ServiceBinding binding;
    binding.port = in.get_string();
    binding.operations = get_service_operations(in);
    if (!in.ok()) throw LinkError("a service binding of the peer is damaged");
    return binding;
}

std::vector<std::byte> encode(const std::vector<std::string>& port_names) {
    std::vector<std::byte> bytes;
    wire::CdrWriter out(bytes);
    out.put(static_cast<std::uint32_t>(port_names.size()));
    for (const auto& name : port_names) out.put_string(name);
    return bytes;
}

std::vector<std::string> decode_port_names(std::span<const std::byte> bytes) {
    wire::CdrReader in(bytes);
    std::vector<std::string> names(in.get_count(min_string_bytes));
    for (auto& name : names) name = in.get_string();
    if (!in.ok()) throw LinkError("a list of port names of the peer is damaged");
    return names;
}

std::vector<std::byte> encode(const StateReport& report) {
    std::vector<std::byte> bytes;
    wire::CdrWriter out(bytes);
    out.put_string(report.component);
    out.put(static_cast<std::uint32_t>(report.state));
    out.put(report.sequence);
    return bytes;
}

StateReport decode_state_report(std::span<const std::byte> bytes) {
    wire::CdrReader in(bytes);
    StateReport report;
    report.component = in.get_string();
    report.state = static_cast<ComponentState>(in.get<std::uint32_t>());
    report.sequence = in.get<std::uint64_t>();
    if (!in.ok() || report.state > ComponentState::destroyed)
        throw LinkError("a state report of the peer is damaged");
    return report;
}

std::vector<std::byte> encode(const Setting& setting) {
    std::vector<std::byte> bytes;
    wire::CdrWriter out(bytes);
    for (const auto* text : {&setting.component, &setting.name, &setting.value}) out.put_string(*text);
    return bytes;
}

Setting decode_setting(std::span<const std::byte> bytes) {
    wire::CdrReader in(bytes);
    Setting setting;
    for (auto* text : {&setting.component, &setting.name, &setting.value}) *text = in.get_string();
    if (!in.ok()) throw LinkError("a setting of the peer is damaged");
    return setting;
}

std::vector<std::byte> encode_string(std::string_view text) {
    std::vector<std::byte> bytes;
    wire::CdrWriter(bytes).put_string(text);
    return bytes;
}

std::string decode_string(std::span<const std::byte> bytes) {
    return std::string(wire::CdrReader(bytes).get_string());
}

} // namespace tandem::link::control
