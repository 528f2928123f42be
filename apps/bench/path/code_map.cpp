// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/path/code_map.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <sstream>

namespace tandem::bench {

CodeMap::CodeMap(pid_t process) {
    std::ifstream file(fmt::format("/proc/{}/maps", process));
    for (std::string line; std::getline(file, line);) { // "begin-end r-xp offset device inode file", proc(5)
        std::istringstream in(line);
        Mapping mapping{};
        char dash = 0;
        std::string permissions, device, inode;
        in >> std::hex >> mapping.begin >> dash >> mapping.end >> permissions >> mapping.file_offset >>
            device >> inode >> std::ws;
        std::getline(in, mapping.file);
        if (permissions.find('x') != std::string::npos) mappings_.push_back(mapping);
    }
}

const CodeMap::Mapping* CodeMap::find(std::uint64_t address) const {
    for (const Mapping& mapping : mappings_)
        if (address >= mapping.begin && address < mapping.end) return &mapping;
    return nullptr;
}

const SymbolTable& CodeMap::symbols_of(const Mapping& mapping) {
    return symbols_.try_emplace(mapping.file, mapping.file).first->second;
}

std::string CodeMap::function_at(std::uint64_t address) {
    const Mapping* const mapping = find(address);
    if (mapping == nullptr || mapping->file.empty()) return "unmapped";
    return std::filesystem::path(mapping->file).filename().string() + " " +
           symbols_of(*mapping).function_at(address - mapping->begin + mapping->file_offset);
}

bool CodeMap::is_allocation(std::uint64_t address) {
    const Mapping* const mapping = find(address);
    return mapping != nullptr && mapping->file.find("libc.so") != std::string::npos &&
           symbols_of(*mapping).is_start_of(
               address - mapping->begin + mapping->file_offset,
               {"malloc", "calloc", "realloc", "aligned_alloc", "posix_memalign", "memalign"});
}

bool CodeMap::is_of_kernel(std::uint64_t address) const {
    const Mapping* const mapping = find(address);
    return mapping != nullptr && (mapping->file == "[vdso]" || mapping->file == "[vsyscall]");
}

} // namespace tandem::bench
