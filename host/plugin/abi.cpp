// SPDX-License-Identifier: Apache-2.0
#include "host/plugin/abi.hpp"

#include "host/plugin/error.hpp"

#include <cstring>
#include <link.h>

namespace tandem::plugin {
namespace {

using Numbers = std::set<std::uint32_t>;

std::string listed(const Numbers& numbers) {
    std::string text;
    for (const std::uint32_t number : numbers) text += (text.empty() ? "" : " and ") + std::to_string(number);
    return text;
}

[[noreturn]] void refuse(const std::string& subject, const Numbers& numbers, Model model, std::uint32_t ours,
                         const std::string& remedy) {
    const std::string name = model == Model::opros ? "OPRoS ABI" : "RTM ABI";
    const std::string built_against = numbers.empty() ? " or of the original (it has no " + name + " number"
                                                      : " (" + name + " " + listed(numbers);
    throw Error(Reason::another_abi, subject + " was built against the headers of another Tandem" +
                                         built_against + ", here it is " + std::to_string(ours) +
                                         "); build it again" + remedy);
}

/// The notes of what is loaded, until one of another number has been found.
struct Search {
    std::string owner;
    std::uint32_t ours;
    std::string after{};  ///< what was loaded before this library is not looked at
    std::string object{}; ///< its file, empty for the program
    Numbers others{};

    void look_at(const char* at, const char* end, std::size_t alignment) {
        const auto aligned = [&](std::size_t bytes) {
            return (bytes + alignment - 1) / alignment * alignment;
        };
        while (static_cast<std::size_t>(end - at) > sizeof(ElfW(Nhdr))) {
            ElfW(Nhdr) note;
            std::memcpy(&note, at, sizeof note);
            const char* const name = at + sizeof note;
            const std::size_t to_number = aligned(sizeof note + note.n_namesz);
            const std::size_t whole = aligned(to_number + note.n_descsz);
            if (whole > static_cast<std::size_t>(end - at)) return;
            std::uint32_t number = ours;
            if (note.n_type == 1 && note.n_descsz == sizeof number && note.n_namesz == owner.size() + 1 &&
                std::memcmp(name, owner.c_str(), note.n_namesz) == 0)
                std::memcpy(&number, at + to_number, sizeof number);
            if (number != ours) others.insert(number);
            at += whole;
        }
    }
};

int look_at_object(dl_phdr_info* object, std::size_t, void* argument) {
    auto& search = *static_cast<Search*>(argument);
    if (search.after == object->dlpi_name) search.after.clear();
    if (!search.after.empty()) return 0;
    for (int i = 0; i < object->dlpi_phnum; ++i) {
        const auto& segment = object->dlpi_phdr[i];
        if (segment.p_type != PT_NOTE) continue;
        const char* const start = reinterpret_cast<const char*>(object->dlpi_addr + segment.p_vaddr);
        search.look_at(start, start + segment.p_memsz, segment.p_align == 8 ? 8 : 4);
    }
    if (search.others.empty()) return 0;
    search.object = object->dlpi_name;
    return 1; // the first one is enough
}

} // namespace

void require_abi(const std::filesystem::path& library, const Contents& contents, Model model,
                 std::uint32_t ours) {
    const Headers& headers = model == Model::opros ? contents.opros : contents.rtm;
    if (headers.abi.empty() ? !headers.used : headers.abi == Numbers{ours}) return;
    refuse("library " + library.string(), headers.abi, model, ours,
           std::string(": tandem ") + (model == Model::opros ? "opros" : "rtm") + " build DIR");
}

void require_abi_of_process(Model model, std::uint32_t ours, const std::filesystem::path& plugin) {
    Search search{note_owner(model), ours, plugin.string()};
    dl_iterate_phdr(look_at_object, &search);
    if (search.others.empty()) return;
    std::error_code none;
    const std::string object =
        search.object.empty() ? "program " + std::filesystem::read_symlink("/proc/self/exe", none).string()
                              : "library " + search.object;
    const std::string needed = plugin.empty() ? "" : ", which " + plugin.string() + " needs,";
    refuse(object + needed, search.others, model, ours, "");
}

} // namespace tandem::plugin
