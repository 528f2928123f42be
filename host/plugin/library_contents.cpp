// SPDX-License-Identifier: Apache-2.0
#include "host/plugin/library_contents.hpp"

#include "host/plugin/elf_file.hpp"
#include "host/plugin/error.hpp"

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <map>
#include <mutex>
#include <optional>
#include <sys/stat.h>
#include <utility>

namespace tandem::plugin {
namespace {

// Undefined symbols whose mangled names contain the class's name are calls into the model's library.
bool uses_class(const ElfContents& elf, const std::string& mangled) {
    return std::any_of(elf.undefined.begin(), elf.undefined.end(),
                       [&](const std::string& name) { return name.find(mangled) != std::string::npos; });
}

HeaderUse header_use(ElfContents& elf, ComponentModel model, const std::string& mangled) {
    return {std::move(elf.note_numbers[elf_note_name(model)]), uses_class(elf, mangled)};
}

// An RTC module's init function is NAMEInit, after its file NAME. The file may have been renamed, so any exported C
// function with this suffix counts.
std::string init_function(const std::set<std::string>& exports) {
    if (exports.contains("rtc_init")) return "rtc_init";
    const auto is_init = [](const std::string& name) { return name.size() > 4 && name.ends_with("Init"); };
    const auto found = std::find_if(exports.begin(), exports.end(), is_init);
    return found == exports.end() ? "" : *found;
}

// Returns, for messages, the kind and the function that identifies it.
const char* expected_text(LibraryKind kind) {
    switch (kind) {
    case LibraryKind::opros_component:
        return "an OPRoS component, which exports getComponent";
    case LibraryKind::rtc_module:
        return "an RTC module, which exports NAMEInit (extern \"C\")";
    case LibraryKind::device_api:
        return "a device API, which exports GetAPI (extern \"C\")";
    default:
        return kind_text(kind);
    }
}

// Returns what to do with a library of this kind.
const char* remedy(LibraryKind kind) {
    if (kind == LibraryKind::rtc_module) return "; rtm_host runs it";
    if (kind == LibraryKind::opros_component) return "; opros_host runs it";
    if (kind == LibraryKind::device_api) return "; a component opens it, by its property APIName";
    return "";
}

} // namespace

const char* elf_note_name(ComponentModel model) {
    return model == ComponentModel::opros ? "TandemOPRoS" : "TandemRTM";
}

const char* kind_text(LibraryKind kind) {
    switch (kind) {
    case LibraryKind::opros_component:
        return "an OPRoS component";
    case LibraryKind::rtc_module:
        return "an RTC module";
    case LibraryKind::device_api:
        return "a device API";
    case LibraryKind::other:
        break;
    }
    return "neither an OPRoS component nor an RTC module nor a device API";
}

namespace {

LibraryContents read_file(const std::filesystem::path& library) {
    ElfContents elf = read_elf(library);
    LibraryContents contents;
    contents.opros =
        header_use(elf, ComponentModel::opros, "_ZN9ComponentC2E");      // the constructor of Component
    contents.rtm = header_use(elf, ComponentModel::rtm, "3RTC7Manager"); // RTC::Manager
    for (const char* base :
         {"14InPortProviderE", "14InPortConsumerE", "15OutPortProviderE", "15OutPortConsumerE"})
        contents.is_transport = contents.is_transport || uses_class(elf, base);
    // getComponent decides first: no RTC exports it, but an OPRoS component may export a NAMEInit.
    if (elf.defined.count("getComponent")) {
        contents.kind = LibraryKind::opros_component;
        contents.entry = "getComponent";
    } else if (const std::string init = init_function(elf.defined);
               init == "rtc_init" ||
               (!init.empty() && (contents.rtm.used || !contents.rtm.abi_numbers.empty()))) {
        contents.kind = LibraryKind::rtc_module;
        contents.entry = init;
    } else if (elf.defined.count("GetAPI")) {
        contents.kind = LibraryKind::device_api;
        contents.entry = "GetAPI";
    }
    contents.exports = std::move(elf.defined);
    contents.trusted = elf.note_numbers.contains("TandemTrusted");
    return contents;
}

/// What differs after a change of a file.
struct FileVersion {
    dev_t device = 0;
    ino_t inode = 0;
    off_t bytes = 0;
    std::int64_t modified_ns = 0, changed_ns = 0;
    bool operator==(const FileVersion&) const = default;
};

std::int64_t in_ns(const timespec& time) { return time.tv_sec * std::int64_t{1'000'000'000} + time.tv_nsec; }

// Returns nothing for a file that cannot be read, or that has just changed: it may change again with the same time.
std::optional<FileVersion> settled_version(const std::filesystem::path& file) {
    struct stat status {};
    if (stat(file.c_str(), &status) != 0) return std::nullopt;
    timespec now{};
    clock_gettime(CLOCK_REALTIME, &now);
    if (in_ns(now) - in_ns(status.st_ctim) < 1'000'000'000) return std::nullopt;
    return FileVersion{status.st_dev, status.st_ino, status.st_size, in_ns(status.st_mtim),
                       in_ns(status.st_ctim)};
}

/// The libraries that this process has read. Never deleted: threads may outlive static objects.
struct KnownLibraries {
    std::mutex mutex;
    std::map<std::filesystem::path, std::pair<FileVersion, LibraryContents>> files;
};
KnownLibraries& known_libraries() {
    static auto* const known = new KnownLibraries;
    return *known;
}

} // namespace

LibraryContents read_contents(const std::filesystem::path& library) {
    auto& known = known_libraries();
    const auto file = std::filesystem::absolute(library);
    const auto version = settled_version(file);
    if (!version) return read_file(library);
    {
        const std::lock_guard lock(known.mutex);
        const auto found = known.files.find(file);
        if (found != known.files.end() && found->second.first == *version) return found->second.second;
    }
    LibraryContents contents = read_file(library);
    const std::lock_guard lock(known.mutex);
    if (settled_version(file) == version) known.files[file] = {*version, contents};
    return contents;
}

void require_kind(const std::filesystem::path& library, const LibraryContents& contents, LibraryKind kind) {
    if (contents.kind == kind) return;
    const std::string entry = contents.entry.empty() ? "" : " (exports " + contents.entry + ")";
    throw Error(Reason::wrong_model, "library " + library.string() + " is " + kind_text(contents.kind) +
                                         entry + ", expected " + expected_text(kind) + remedy(contents.kind));
}

} // namespace tandem::plugin
