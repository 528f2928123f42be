// SPDX-License-Identifier: Apache-2.0
#include "host/plugin/elf_file.hpp"

#include "host/plugin/error.hpp"
#include "host/process/file_descriptor.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <gelf.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tandem::plugin {
namespace {

/// An open ELF file. libelf reads it piece by piece and checks most pieces against the file's size. contains_range()
/// checks the others.
class ElfFile {
  public:
    explicit ElfFile(const std::filesystem::path& file) : file_(file) {
        // libelf requires this call before all others.
        static const bool version_known = elf_version(EV_CURRENT) != EV_NONE;
        // O_NONBLOCK: opening a named pipe would otherwise wait for a writer forever.
        fd_ = process::FileDescriptor(open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
        if (!fd_) fail(Reason::not_found, std::string("cannot be opened: ") + std::strerror(errno));
        struct stat status {};
        if (fstat(fd_.get(), &status) != 0 || !S_ISREG(status.st_mode))
            fail(Reason::not_found, "is not a file");
        size_ = static_cast<std::uint64_t>(status.st_size);
        elf_ = version_known ? elf_begin(fd_.get(), ELF_C_READ, nullptr) : nullptr;
    }
    ~ElfFile() { elf_end(elf_); }
    ElfFile(const ElfFile&) = delete;
    ElfFile& operator=(const ElfFile&) = delete;

    Elf* get() const { return elf_; }
    bool contains_range(std::uint64_t offset, std::uint64_t bytes) const {
        return offset <= size_ && bytes <= size_ - offset;
    }
    std::uint64_t size() const { return size_; }

    GElf_Ehdr header() const {
        if (size_ == 0) fail(Reason::damaged, "is empty");
        if (elf_kind(elf_) != ELF_K_ELF) fail_not_elf();
        GElf_Ehdr header;
        if (!gelf_getehdr(elf_, &header)) fail_damaged("its ELF header cannot be read");
        return header;
    }
    [[noreturn]] void fail(Reason reason, const std::string& why) const {
        throw Error(reason, "library " + file_.string() + " " + why);
    }
    [[noreturn]] void fail_damaged(const std::string& what) const {
        fail(Reason::damaged, "is damaged: " + what + "; build or copy it again");
    }

  private:
    // A Windows library begins with "MZ". Users try to load such OPRoS components.
    [[noreturn]] void fail_not_elf() const {
        char start[2] = {};
        if (pread(fd_.get(), start, 2, 0) == 2 && start[0] == 'M' && start[1] == 'Z')
            fail(Reason::not_a_library,
                 "is for Windows; build the component from its source: tandem opros build");
        fail(Reason::not_a_library, "is not a shared library (not an ELF file)");
    }

    std::filesystem::path file_;
    process::FileDescriptor fd_;
    std::uint64_t size_ = 0;
    Elf* elf_ = nullptr;
};

std::string machine_name(unsigned machine) {
    switch (machine) {
    case EM_386:
        return "32-bit x86";
    case EM_X86_64:
        return "x86-64";
    case EM_ARM:
        return "32-bit ARM";
    case EM_AARCH64:
        return "64-bit ARM";
    case EM_RISCV:
        return "RISC-V";
    default:
        return "machine " + std::to_string(machine);
    }
}

// Compares with this program's file, which runs on this machine.
void check_machine(const ElfFile& elf, const GElf_Ehdr& header) {
    const ElfFile own("/proc/self/exe");
    const GElf_Ehdr own_header = own.header();
    const bool same = header.e_machine == own_header.e_machine &&
                      header.e_ident[EI_CLASS] == own_header.e_ident[EI_CLASS] &&
                      header.e_ident[EI_DATA] == own_header.e_ident[EI_DATA];
    if (!same)
        elf.fail(Reason::wrong_architecture, "is for " + machine_name(header.e_machine) +
                                                 ", this machine is " + machine_name(own_header.e_machine) +
                                                 "; build it here");
}

void check_type(const ElfFile& elf, const GElf_Ehdr& header) {
    if (header.e_type == ET_DYN) return;
    const char* what = header.e_type == ET_REL    ? "an object file"
                       : header.e_type == ET_EXEC ? "a program"
                                                  : "no library";
    elf.fail(Reason::not_a_library,
             std::string("is ") + what + ", expected a shared library (link it with -shared)");
}

// The dynamic linker maps PT_LOAD segments without checking them against the file's size.
void check_segments(const ElfFile& elf) {
    std::size_t count = 0;
    if (elf_getphdrnum(elf.get(), &count) != 0) elf.fail_damaged("its program headers cannot be read");
    for (std::size_t i = 0; i < count; ++i) {
        GElf_Phdr segment;
        if (!gelf_getphdr(elf.get(), static_cast<int>(i), &segment))
            elf.fail_damaged("program header " + std::to_string(i) + " is not in the file");
        if (segment.p_type == PT_LOAD && !elf.contains_range(segment.p_offset, segment.p_filesz))
            elf.fail_damaged("it ends at byte " + std::to_string(elf.size()) + ", before the " +
                             std::to_string(segment.p_filesz) + " bytes at " +
                             std::to_string(segment.p_offset) + " that must be mapped");
    }
}

void read_symbols(const ElfFile& elf, Elf_Scn* section, const GElf_Shdr& header, ElfContents& contents) {
    Elf_Data* data = elf_getdata(section, nullptr);
    if (!data || header.sh_entsize == 0) elf.fail_damaged("its dynamic symbols cannot be read");
    const auto count = header.sh_size / header.sh_entsize;
    for (std::size_t i = 1; i < count; ++i) { // the ELF specification reserves symbol 0
        GElf_Sym symbol;
        if (!gelf_getsym(data, static_cast<int>(i), &symbol)) elf.fail_damaged("it lacks dynamic symbols");
        const char* name = elf_strptr(elf.get(), header.sh_link, symbol.st_name);
        if (!name) elf.fail_damaged("a dynamic symbol's name is not in the file");
        if (GELF_ST_BIND(symbol.st_info) == STB_LOCAL || !*name) continue;
        if (symbol.st_shndx == SHN_UNDEF)
            contents.undefined.emplace_back(name);
        else if (std::strncmp(name, "_Z", 2) != 0) // skips thousands of C++ names, which nothing looks up
            contents.defined.emplace(name);
    }
}

// Reads notes of type 1 with a description of four bytes, the format of TandemAbi.h. Skips all others.
void read_notes(const ElfFile& elf, Elf_Scn* section, ElfContents& contents) {
    Elf_Data* data = elf_getdata(section, nullptr);
    if (!data) elf.fail_damaged("its notes cannot be read");
    const auto* bytes = static_cast<const char*>(data->d_buf);
    GElf_Nhdr note;
    std::size_t name = 0, description = 0;
    for (std::size_t at = 0; (at = gelf_getnote(data, at, &note, &name, &description)) > 0;) {
        std::uint32_t number = 0;
        if (note.n_type != 1 || note.n_descsz != sizeof number || note.n_namesz == 0) continue;
        std::memcpy(&number, bytes + description, sizeof number);
        contents.note_numbers[std::string(bytes + name, note.n_namesz - 1)].insert(number);
    }
}

} // namespace

ElfContents read_elf(const std::filesystem::path& library) {
    const ElfFile elf(library);
    const GElf_Ehdr header = elf.header();
    check_machine(elf, header);
    check_type(elf, header);
    check_segments(elf);
    // Without section headers, libelf finds neither symbols nor notes, although the library may be loadable.
    if (header.e_shoff == 0)
        elf.fail(
            Reason::damaged,
            "has no section headers, without which it cannot be checked before it is loaded; link it again");
    ElfContents contents;
    bool found = false;
    for (Elf_Scn* section = nullptr; (section = elf_nextscn(elf.get(), section));) {
        GElf_Shdr section_header;
        if (!gelf_getshdr(section, &section_header)) elf.fail_damaged("a section header is not in the file");
        if (section_header.sh_type == SHT_NOTE) read_notes(elf, section, contents);
        if (section_header.sh_type != SHT_DYNSYM) continue;
        found = true;
        read_symbols(elf, section, section_header, contents);
    }
    if (!found) elf.fail_damaged("it has no dynamic symbols, its end may be missing");
    return contents;
}

} // namespace tandem::plugin
