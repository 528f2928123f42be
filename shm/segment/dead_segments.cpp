// SPDX-License-Identifier: Apache-2.0
#include "shm/segment/dead_segments.hpp"

#include "shm/os/error.hpp"
#include "shm/segment/segment_file.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <string>
#include <string_view>
#include <unistd.h>

namespace tandem::shm {
namespace {

/// Returns whether the file has the header of a segment of this layout in which a side has joined. Any other file may be
/// no segment at all.
bool is_segment_with_a_side(const std::string& path) {
    const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    if (!file) return false;
    using layout::SegmentHeader;
    using layout::SideHeader;
    const auto read_word = [&](std::size_t offset) {
        std::uint32_t word = 0; // reads as 0 beyond the end of the file
        const auto at = static_cast<off_t>(offset);
        return pread(file.get(), &word, sizeof word, at) == sizeof word ? word : 0;
    };
    const auto magic_word = [](int shift) { return static_cast<std::uint32_t>(layout::magic >> shift); };
    const std::size_t first_side = sizeof(SegmentHeader) + offsetof(SideHeader, taken);
    return read_word(0) == magic_word(0) && read_word(4) == magic_word(32) &&
           read_word(offsetof(SegmentHeader, layout_version)) == layout::layout_version &&
           (read_word(first_side) != 0 || read_word(first_side + sizeof(SideHeader)) != 0);
}

void remove_if_left_behind(const std::string& path) {
    if (probe_segment(path).dead() && is_segment_with_a_side(path)) remove_if_dead(path);
}

} // namespace

void remove_dead_segments() {
    if (std::getenv("TANDEM_KEEP_DEAD_SEGMENTS") != nullptr) return;
    std::error_code failure;
    for (std::filesystem::directory_iterator at(shm_directory, failure), end; !failure && at != end;
         at.increment(failure)) {
        constexpr std::string_view prefix = "tandem.";
        if (at->path().filename().string().compare(0, prefix.size(), prefix) != 0) continue;
        try {
            remove_if_left_behind(at->path());
        } catch (const Error&) {
            continue; // a file of another kind, or one that this process may not read
        }
    }
}

} // namespace tandem::shm
