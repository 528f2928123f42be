// SPDX-License-Identifier: Apache-2.0
// The connections of ports that this process was to make and could not, where other processes of the same user can read them
// without asking: in a memory file without a name (memfd_create), found as /proc/PID/fd/N, which ends with the process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace tandem::process {

/// Texts are NUL-terminated, and cut where they are too long.
struct RefusedConnection {
    std::uint64_t taken;   ///< 0: the place is free; stored last when it is taken
    char from[96], to[96]; ///< COMPONENT.PORT
    char reason[824];
};

struct RefusedConnections {
    static constexpr char magic_text[8] = {'T', 'A', 'N', 'D', 'R', 'E', 'F', '1'};
    static constexpr const char* file_name = "tandem-refused";
    static constexpr std::size_t places = 32; ///< of more, nobody else learns
    char magic[8];
    RefusedConnection place[places];
};

/// One that could not be made, for as long as this object lives. The file is made with the first one; without it, or without
/// room in it, only the log tells. [construction and destruction: any-thread]
class OwnRefusedConnection {
  public:
    OwnRefusedConnection(const std::string& from, const std::string& to, const std::string& reason);
    ~OwnRefusedConnection();
    OwnRefusedConnection(const OwnRefusedConnection&) = delete;
    OwnRefusedConnection& operator=(const OwnRefusedConnection&) = delete;

  private:
    RefusedConnection* place_ = nullptr;
};

} // namespace tandem::process
