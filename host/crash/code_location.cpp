// SPDX-License-Identifier: Apache-2.0
// dladdr() takes the dynamic linker's lock and knows only exported functions. This file gets the loaded file from
// _dl_find_object(), which takes no lock, and the function from the file's own symbol table.
#include "host/crash/code_location.hpp"

#include <cstring>
#include <dlfcn.h>
#include <elf.h>
#include <fcntl.h>
#include <link.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tandem::crash {
namespace {

using Header = ElfW(Ehdr);
using Section = ElfW(Shdr);
using Symbol = ElfW(Sym);

void copy(std::array<char, 1024>& to, const char* text) {
    const std::size_t length = strnlen(text, to.size() - 1);
    std::memcpy(to.data(), text, length);
    to[length] = '\0';
}

/// A file mapped for reading. It may differ from the loaded file, so all its contents are checked.
class ElfImage {
  public:
    explicit ElfImage(const char* path) {
        const int file = open(path, O_RDONLY | O_CLOEXEC);
        struct stat status {};
        if (file >= 0 && fstat(file, &status) == 0 && status.st_size > 0) {
            size_ = static_cast<std::size_t>(status.st_size);
            void* mapped = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file, 0);
            if (mapped != MAP_FAILED) begin_ = static_cast<const char*>(mapped);
        }
        if (file >= 0) close(file);
    }
    ~ElfImage() {
        if (begin_ != nullptr) munmap(const_cast<char*>(begin_), size_);
    }
    ElfImage(const ElfImage&) = delete;
    ElfImage& operator=(const ElfImage&) = delete;

    /// Finds the function at location.offset. Prefers the full symbol table to the table of exported symbols.
    void find_function(CodeLocation& location) const {
        const auto* header = at<Header>(0, 1);
        if (header == nullptr || std::memcmp(header->e_ident, ELFMAG, SELFMAG) != 0) return;
        const auto* sections = at<Section>(header->e_shoff, header->e_shnum);
        if (sections == nullptr) return;
        for (const unsigned type : {SHT_SYMTAB, SHT_DYNSYM})
            for (unsigned i = 0; i < header->e_shnum; ++i)
                if (sections[i].sh_type == type && sections[i].sh_link < header->e_shnum &&
                    find_in_table(sections[i], sections[sections[i].sh_link], location))
                    return;
    }

  private:
    /// Returns NULL if the file does not contain `count` objects there.
    template <class T>
    const T* at(std::uint64_t offset, std::uint64_t count) const {
        if (begin_ == nullptr || offset > size_ || count > (size_ - offset) / sizeof(T)) return nullptr;
        if (offset % alignof(T) != 0) return nullptr;
        return reinterpret_cast<const T*>(begin_ + offset);
    }

    bool find_in_table(const Section& table, const Section& names, CodeLocation& location) const {
        const std::uint64_t count = table.sh_size / sizeof(Symbol);
        const auto* symbols = at<Symbol>(table.sh_offset, count);
        const char* texts = at<char>(names.sh_offset, names.sh_size);
        if (symbols == nullptr || texts == nullptr) return false;
        for (std::uint64_t i = 0; i < count; ++i) {
            const Symbol& symbol = symbols[i];
            if (ELF64_ST_TYPE(symbol.st_info) != STT_FUNC || symbol.st_shndx == SHN_UNDEF) continue;
            if (location.offset < symbol.st_value || location.offset - symbol.st_value >= symbol.st_size)
                continue;
            if (symbol.st_name >= names.sh_size) return false;
            const char* name = texts + symbol.st_name;
            if (std::memchr(name, '\0', names.sh_size - symbol.st_name) == nullptr) return false;
            copy(location.symbol, name);
            location.symbol_offset = location.offset - symbol.st_value;
            return true;
        }
        return false;
    }

    const char* begin_ = nullptr;
    std::size_t size_ = 0;
};

} // namespace

CodeLocation locate(std::uintptr_t address) {
    CodeLocation location;
    dl_find_object found{};
    auto* const object = reinterpret_cast<void*>(address); // NOLINT(performance-no-int-to-ptr)
    if (_dl_find_object(object, &found) != 0 || found.dlfo_link_map == nullptr) return location;
    location.offset = address - found.dlfo_link_map->l_addr;
    if (const char* name = found.dlfo_link_map->l_name; name != nullptr && *name != '\0')
        copy(location.file, name);
    else if (readlink("/proc/self/exe", location.file.data(), location.file.size() - 1) < 0)
        copy(location.file, "the host");
    ElfImage(location.file.data()).find_function(location);
    return location;
}

} // namespace tandem::crash
