// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <iosfwd>
#include <string>
#include <vector>

namespace tandem::process {

struct ListeningSocket {
    std::string address; ///< ADDRESS:PORT in hexadecimal digits, as in the table
    std::string inode;
};

/// Reads the listening TCP sockets of a table /proc/net/tcp or /proc/net/tcp6. The format is described in proc_pid_net(5).
std::vector<ListeningSocket> read_listening_sockets(std::istream& table);

} // namespace tandem::process
