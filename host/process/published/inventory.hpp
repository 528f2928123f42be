// SPDX-License-Identifier: Apache-2.0
// Lists the parts of this process: its components, their ports and execution contexts, and the connections between ports.
// Other processes of the same user can read the list without asking this process: it is in a memory file without a path
// (memfd_create), which they find as /proc/PID/fd/N. The file ends with the process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tandem::process {

/// The head of the file; native byte order. The text follows: one line per part, of fields between tabs. Spaces at the end
/// of a line and empty lines are ignored. The parts, in any order:
///     component  NAME TYPE EXECUTION PERIOD_NS NAME_IN_NAME_SERVER...
///     context    OWNER KIND PERIOD_NS RUNNING(0|1) COMPONENT...
///     port       COMPONENT NAME KIND(data|event|service) DIRECTION(input|output|provided|required) TYPE CONNECTION_ID...
///     connection FROM_COMPONENT FROM_PORT TO_COMPONENT TO_PORT
/// Connected ports have a CONNECTION_ID in common, even ports of two processes. A composite is the owner of the context that
/// its members share.
struct InventoryHead {
    static constexpr char magic_text[8] = {'T', 'A', 'N', 'D', 'I', 'N', 'V', '1'};
    static constexpr const char* file_name = "tandem-inventory";
    static constexpr std::size_t max_text_bytes = std::size_t{1} << 20;
    static constexpr std::size_t file_bytes = max_text_bytes + 4096; ///< sparse
    char magic[8];
    std::uint64_t sequence; ///< odd while the file changes; another number after each change
    std::uint64_t text_bytes;
    std::uint64_t left_out; ///< parts for which the text has no room
};

/// Lists a part, or replaces what was listed for it. `part` identifies it until unlist_part(). The cost depends on the length
/// of the line, except that the text is sometimes compacted. If a write to the file fails, the file is closed, and nothing is
/// listed from then on. [any-thread; waits for no component]
void list_part(const void* part, const std::vector<std::string>& fields);

/// Takes the part off the list, if it is listed. [any-thread]
void unlist_part(const void* part);

} // namespace tandem::process
