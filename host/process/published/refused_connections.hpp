// SPDX-License-Identifier: Apache-2.0
// Lists the port connections that this process was told to make and could not. Other processes of the same user can
// read the list without asking this process: it is in a memory file without a path (memfd_create), which they find as
// /proc/PID/fd/N. The file ends with the process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace tandem::process {

/// Texts are NUL-terminated and truncated to fit.
struct RefusedConnection {
    std::uint64_t taken;   ///< 0: the place is free; written last when a connection takes it
    char from[96], to[96]; ///< COMPONENT.PORT
    char reason[824];
};

struct RefusedConnections {
    static constexpr char magic_text[8] = {'T', 'A', 'N', 'D', 'R', 'E', 'F', '1'};
    static constexpr const char* file_name = "tandem-refused";
    static constexpr std::size_t places = 32; ///< further refused connections are only in the log
    char magic[8];
    RefusedConnection place[places];
};

/// Lists one refused connection for as long as this object lives. The first object creates the file. If there is no
/// file or no free place in it, only the log reports the connection. [construction and destruction: any-thread]
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
