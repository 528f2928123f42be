// SPDX-License-Identifier: Apache-2.0
#include "host/plugin/abi.hpp"

#include "host/plugin/error.hpp"

#include <cstring>
#include <link.h>

namespace tandem::plugin {
namespace {

using Numbers = std::set<std::uint32_t>;

std::string joined(const Numbers& numbers) {
    std::string text;
    for (const std::uint32_t number : numbers) text += (text.empty() ? "" : " and ") + std::to_string(number);
    return text;
}

[[noreturn]] void refuse(const std::string& subject, const Numbers& numbers, ComponentModel model,
                         std::uint32_t expected, const std::string& remedy) {
    const std::string name = model == ComponentModel::opros ? "OPRoS ABI" : "RTM ABI";
    const std::string built_against = numbers.empty() ? " or of the original (it has no " + name + " number"
                                                      : " (" + name + " " + joined(numbers);
    throw Error(Reason::abi_mismatch, subject + " was built against the headers of another Tandem" +
                                          built_against + ", here it is " + std::to_string(expected) +
                                          "); build it again" + remedy);
}

/// Searches the notes of loaded objects for ABI numbers of `owner` other than the expected one. The argument of
/// dl_iterate_phdr().
struct NoteSearch {
    std::string owner;
    std::uint32_t expected;
    std::string after{};  ///< objects before this library are skipped; empty: no object is skipped
    std::string object{}; ///< file of the first object with another number; empty: the program
    Numbers others{};

    /// Reads the notes of one PT_NOTE segment. The name and description of each note are padded to `alignment` bytes.
    void search_notes(const char* at, const char* end, std::size_t alignment) {
        const auto aligned = [&](std::size_t bytes) {
            return (bytes + alignment - 1) / alignment * alignment;
        };
        while (static_cast<std::size_t>(end - at) > sizeof(ElfW(Nhdr))) {
            ElfW(Nhdr) note;
            std::memcpy(&note, at, sizeof note);
            const char* const name = at + sizeof note;
            const std::size_t to_number = aligned(sizeof note + note.n_namesz);
            const std::size_t whole = aligned(to_number + note.n_descsz);
            if (whole > static_cast<std::size_t>(end - at)) return; // the note's sizes are wrong
            std::uint32_t number = expected;
            if (note.n_type == 1 && note.n_descsz == sizeof number && note.n_namesz == owner.size() + 1 &&
                std::memcmp(name, owner.c_str(), note.n_namesz) == 0)
                std::memcpy(&number, at + to_number, sizeof number);
            if (number != expected) others.insert(number);
            at += whole;
        }
    }
};

// dl_iterate_phdr() calls this function in load order, beginning with the program.
int search_object(dl_phdr_info* object, std::size_t, void* argument) {
    auto& search = *static_cast<NoteSearch*>(argument);
    if (search.after == object->dlpi_name) search.after.clear();
    if (!search.after.empty()) return 0;
    for (int i = 0; i < object->dlpi_phnum; ++i) {
        const auto& segment = object->dlpi_phdr[i];
        if (segment.p_type != PT_NOTE) continue; // notes are mapped, section headers are not
        // NOLINTNEXTLINE(performance-no-int-to-ptr): the dynamic linker gives addresses as numbers
        const char* const start = reinterpret_cast<const char*>(object->dlpi_addr + segment.p_vaddr);
        search.search_notes(start, start + segment.p_memsz, segment.p_align == 8 ? 8 : 4);
    }
    if (search.others.empty()) return 0;
    search.object = object->dlpi_name;
    return 1; // ends dl_iterate_phdr()
}

} // namespace

void require_abi(const std::filesystem::path& library, const LibraryContents& contents, ComponentModel model,
                 std::uint32_t expected) {
    const HeaderUse& headers = model == ComponentModel::opros ? contents.opros : contents.rtm;
    if (headers.abi_numbers.empty() ? !headers.used : headers.abi_numbers == Numbers{expected}) return;
    refuse("library " + library.string(), headers.abi_numbers, model, expected,
           std::string(": tandem ") + (model == ComponentModel::opros ? "opros" : "rtm") + " build DIR");
}

void require_abi_of_process(ComponentModel model, std::uint32_t expected,
                            const std::filesystem::path& plugin) {
    NoteSearch search{elf_note_name(model), expected, plugin.string()};
    dl_iterate_phdr(search_object, &search);
    if (search.others.empty()) return;
    std::error_code none;
    const std::string object =
        search.object.empty() ? "program " + std::filesystem::read_symlink("/proc/self/exe", none).string()
                              : "library " + search.object;
    const std::string needed = plugin.empty() ? "" : ", which " + plugin.string() + " needs,";
    refuse(object + needed, search.others, model, expected, "");
}

} // namespace tandem::plugin
