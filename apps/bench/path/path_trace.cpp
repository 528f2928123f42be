// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/path/path_trace.hpp"

#include "apps/bench/path/tracer.hpp"
#include "host/process/run_command.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <set>
#include <sstream>

namespace tandem::bench {

namespace {

struct Function {
    std::uint64_t size = 0;
    std::vector<std::string> names; // aliases of one function
};
using Functions = std::map<std::uint64_t, Function>; // by address in the file

/// Adds the functions of one of the file's symbol tables; none for a file that cannot be read.
void add_functions(const std::string& file, bool dynamic, Functions& functions) {
    constexpr std::uint64_t plt_stub_bytes = 16;
    std::vector<std::string> command{"nm", "--defined-only", "--demangle", "--no-sort", "--print-size"};
    if (dynamic) command.insert(command.end(), {"--dynamic", "--synthetic"}); // synthetic: "malloc@plt"
    command.push_back(file);
    const auto nm = process::run_command(command);
    std::istringstream lines(nm.output);
    for (std::string line; std::getline(lines, line);) { // "address [size] type name"
        std::istringstream in(line);
        std::uint64_t address = 0, size = 0;
        in >> std::hex >> address >> size; // fails at the type if there is no size
        in.clear();
        std::string type, name;
        in >> type >> std::ws;
        std::getline(in, name);
        if (type.size() != 1 || std::string("tTwWi").find(type) == std::string::npos) continue;
        Function& function = functions[address];
        function.size = std::max(function.size, name.ends_with("@plt") ? plt_stub_bytes : size);
        function.names.push_back(name.substr(0, name.find("@@"))); // without the version
    }
}

/// Reads the functions at the first request.
const Functions& functions_of(const std::string& file) {
    static std::map<std::string, Functions> known;
    const auto [found, is_new] = known.try_emplace(file);
    if (is_new && file.front() == '/')
        for (const bool dynamic : {true, false}) add_functions(file, dynamic, found->second);
    return found->second;
}

constexpr std::size_t max_instruction_bytes = 15, line_bytes = 64, page_bytes = 4096;

/// The prefixes of an x86 instruction: Intel SDM volume 2, 2.1.1.
bool is_prefix(unsigned char byte) {
    constexpr std::array<unsigned char, 11> legacy{0x66, 0x67, 0x2e, 0x36, 0x3e, 0x26,
                                                   0x64, 0x65, 0xf0, 0xf2, 0xf3};
    const bool is_rex = (byte & 0xf0U) == 0x40;
    return is_rex || std::find(legacy.begin(), legacy.end(), byte) != legacy.end();
}

} // namespace

CodeMap::CodeMap(pid_t process) {
    std::ifstream file(fmt::format("/proc/{}/maps", process));
    std::map<std::string, std::uint64_t> bases;
    for (std::string line; std::getline(file, line);) { // "begin-end r-xp offset device inode file", proc(5)
        std::istringstream in(line);
        Mapping mapping{};
        char dash = 0;
        std::string permissions, offset, device, inode;
        in >> std::hex >> mapping.begin >> dash >> mapping.end >> permissions >> offset >> device >> inode >>
            std::ws;
        std::getline(in, mapping.file);
        mapping.base = bases.try_emplace(mapping.file, mapping.begin).first->second;
        if (permissions.find('x') != std::string::npos) mappings_.push_back(mapping);
    }
}

const CodeMap::Mapping* CodeMap::find(std::uint64_t address) const {
    for (const Mapping& mapping : mappings_)
        if (address >= mapping.begin && address < mapping.end) return &mapping;
    return nullptr;
}

std::string CodeMap::function_at(std::uint64_t address) const {
    const Mapping* const mapping = find(address);
    if (mapping == nullptr || mapping->file.empty()) return "unmapped";
    const std::string file = std::filesystem::path(mapping->file).filename().string();
    const Functions& functions = functions_of(mapping->file);
    auto next = functions.upper_bound(address - mapping->base);
    if (next == functions.begin()) return file + " local function";
    const auto& [begin, function] = *--next;
    // Assembler functions may have size 0.
    const bool is_inside = address - mapping->base < begin + std::max<std::uint64_t>(function.size, 1);
    return file + (is_inside ? " " : " local function behind ") + function.names.front();
}

bool CodeMap::is_allocation(std::uint64_t address) const {
    constexpr std::array names{"malloc", "calloc", "realloc", "aligned_alloc", "posix_memalign", "memalign"};
    const Mapping* const mapping = find(address);
    if (mapping == nullptr || mapping->file.find("libc.so") == std::string::npos) return false;
    const Functions& functions = functions_of(mapping->file);
    const auto found = functions.find(address - mapping->base);
    return found != functions.end() && std::ranges::any_of(found->second.names, [&](const std::string& name) {
               return std::ranges::find(names, name) != names.end();
           });
}

bool CodeMap::is_of_kernel(std::uint64_t address) const {
    const Mapping* const mapping = find(address);
    return mapping != nullptr && (mapping->file == "[vdso]" || mapping->file == "[vsyscall]");
}

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
