// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/path/path_trace.hpp"

#include "apps/bench/path/tracer.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace tandem::bench {

namespace {

constexpr std::size_t max_instruction_bytes = 15, line_bytes = 64, page_bytes = 4096;

/// The prefixes of an x86 instruction: Intel SDM volume 2, 2.1.1.
bool is_prefix(unsigned char byte) {
    constexpr std::array<unsigned char, 11> legacy{0x66, 0x67, 0x2e, 0x36, 0x3e, 0x26,
                                                   0x64, 0x65, 0xf0, 0xf2, 0xf3};
    const bool is_rex = (byte & 0xf0U) == 0x40;
    return is_rex || std::find(legacy.begin(), legacy.end(), byte) != legacy.end();
}

} // namespace

PathTrace::Instruction PathTrace::decode(std::uint64_t address) {
    std::array<unsigned char, max_instruction_bytes + 1> code{};
    read_memory(process_, address, code.data(), max_instruction_bytes);
    Instruction out{};
    std::size_t opcode = 0;
    bool repeats = false;
    for (; opcode + 2 < code.size() && is_prefix(code[opcode]); ++opcode) {
        out.is_locked = out.is_locked || code[opcode] == 0xf0;
        repeats = repeats || code[opcode] == 0xf2 || code[opcode] == 0xf3;
    }
    const unsigned char first = code[opcode], second = code[opcode + 1];
    // xchg with memory locks without a prefix.
    if ((first == 0x86 || first == 0x87) && second < 0xc0) out.is_locked = true;
    // movs, cmps, stos, lods, scas: with a prefix, the processor traps after each repetition.
    out.is_repeated = repeats && ((first >= 0xa4 && first <= 0xa7) || (first >= 0xaa && first <= 0xaf));
    out.is_system_call = first == 0x0f && second == 0x05;
    out.is_allocation = code_.is_allocation(address);
    out.is_of_kernel = code_.is_of_kernel(address);
    return out;
}

void PathTrace::add(const user_regs_struct& registers) {
    const std::uint64_t address = registers.rip;
    const auto [found, is_new] = instructions_.try_emplace(address);
    if (is_new) found->second = decode(address);
    found->second.system_call = registers.rax;
    if (!(found->second.is_repeated && address == last_)) ++found->second.executed;
    last_ = address;
}

PathCounts PathTrace::counts() const {
    PathCounts out;
    std::set<std::uint64_t> lines, pages;
    for (const auto& [address, instruction] : instructions_) {
        if (instruction.is_of_kernel) continue;
        out.instructions += instruction.executed;
        lines.insert(address / line_bytes);
        pages.insert(address / page_bytes);
        if (instruction.is_allocation) out.allocations += instruction.executed;
        if (instruction.is_locked) out.locked += instruction.executed;
        if (instruction.is_system_call) out.system_calls += instruction.executed;
    }
    out.code_lines = static_cast<std::uint32_t>(lines.size());
    out.code_pages = static_cast<std::uint32_t>(pages.size());
    return out;
}

std::vector<std::string> PathTrace::functions() {
    std::map<std::string, std::uint32_t> executed;
    for (const auto& [address, instruction] : instructions_) {
        std::string name = code_.function_at(address);
        if (instruction.is_system_call) name += fmt::format(": system call {}", instruction.system_call);
        if (instruction.is_of_kernel) name += " (not counted)";
        executed[name] += instruction.executed;
    }
    std::vector<std::pair<std::string, std::uint32_t>> sorted(executed.begin(), executed.end());
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const auto& a, const auto& b) { return a.second > b.second; });
    std::vector<std::string> out;
    out.reserve(sorted.size());
    for (const auto& [function, count] : sorted) out.push_back(fmt::format("{:>5} {}", count, function));
    return out;
}

} // namespace tandem::bench
