// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/path/symbol_table.hpp"

#include "host/process/file_descriptor.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <cxxabi.h>
#include <fcntl.h>
#include <gelf.h>
#include <memory>

namespace tandem::bench {

namespace {

std::string demangled(const std::string& name) {
    int status = 0;
    const std::unique_ptr<char, decltype(&std::free)> text(
        abi::__cxa_demangle(name.c_str(), nullptr, nullptr, &status), &std::free);
    return status == 0 && text ? text.get() : name;
}

/// Calls use(symbol, name) for each function of a symbol section.
template <class Use>
void for_each_function(Elf* elf, Elf_Scn* section, const GElf_Shdr& header, Use&& use) {
    Elf_Data* const data = elf_getdata(section, nullptr);
    if (data == nullptr || header.sh_entsize == 0) return;
    for (std::size_t i = 0; i < header.sh_size / header.sh_entsize; ++i) {
        GElf_Sym symbol{};
        if (gelf_getsym(data, static_cast<int>(i), &symbol) == nullptr) continue;
        const int type = GELF_ST_TYPE(symbol.st_info);
        const char* const name = elf_strptr(elf, header.sh_link, symbol.st_name);
        if ((type == STT_FUNC || type == STT_GNU_IFUNC) && symbol.st_shndx != SHN_UNDEF && name != nullptr)
            use(symbol, name);
    }
}

} // namespace

SymbolTable::SymbolTable(const std::string& file) {
    const process::FileDescriptor descriptor(open(file.c_str(), O_RDONLY | O_CLOEXEC));
    elf_version(EV_CURRENT);
    const std::unique_ptr<Elf, decltype(&elf_end)> elf(elf_begin(descriptor.get(), ELF_C_READ, nullptr),
                                                       &elf_end);
    std::size_t segments = 0, names = 0;
    if (!elf || elf_getphdrnum(elf.get(), &segments) != 0 || elf_getshdrstrndx(elf.get(), &names) != 0)
        return;
    for (std::size_t i = 0; i < segments; ++i) {
        GElf_Phdr segment{};
        if (gelf_getphdr(elf.get(), static_cast<int>(i), &segment) != nullptr && segment.p_type == PT_LOAD)
            mapped_.push_back({{segment.p_offset, segment.p_offset + segment.p_filesz}, segment.p_vaddr});
    }
    for (Elf_Scn* section = elf_nextscn(elf.get(), nullptr); section != nullptr;
         section = elf_nextscn(elf.get(), section)) {
        GElf_Shdr header{};
        if (gelf_getshdr(section, &header) == nullptr) continue;
        const char* const name = elf_strptr(elf.get(), names, header.sh_name);
        if (name != nullptr && std::strncmp(name, ".plt", 4) == 0)
            stubs_.push_back({header.sh_addr, header.sh_addr + header.sh_size});
        if (header.sh_type == SHT_SYMTAB || header.sh_type == SHT_DYNSYM)
            for_each_function(elf.get(), section, header, [this](const GElf_Sym& symbol, const char* text) {
                Function& function = functions_[symbol.st_value];
                function.size = std::max<std::uint64_t>(function.size, symbol.st_size);
                function.names.emplace_back(text);
            });
    }
}

/// The address that the linker gave it.
std::uint64_t SymbolTable::address_of(std::uint64_t file_offset) const {
    for (const Mapped& part : mapped_)
        if (part.in_file.contains(file_offset)) return file_offset - part.in_file.begin + part.address;
    return file_offset;
}

std::string SymbolTable::function_at(std::uint64_t file_offset) const {
    const std::uint64_t address = address_of(file_offset);
    for (const Range& range : stubs_)
        if (range.contains(address)) return "PLT stub";
    auto next = functions_.upper_bound(address);
    if (next == functions_.begin()) return "local function";
    const auto& [begin, function] = *--next;
    // Assembler functions may have size 0.
    if (address >= begin + std::max<std::uint64_t>(function.size, 1))
        return "local function behind " + demangled(function.names.front());
    return demangled(function.names.front());
}

bool SymbolTable::is_start_of(std::uint64_t file_offset, const std::vector<std::string>& names) const {
    const auto found = functions_.find(address_of(file_offset));
    if (found == functions_.end()) return false;
    return std::any_of(found->second.names.begin(), found->second.names.end(), [&](const std::string& name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    });
}

} // namespace tandem::bench
