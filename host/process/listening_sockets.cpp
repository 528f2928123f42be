// SPDX-License-Identifier: Apache-2.0
#include "host/process/listening_sockets.hpp"

#include <istream>
#include <sstream>

namespace tandem::process {

std::vector<ListeningSocket> read_listening_sockets(std::istream& table) {
    std::vector<ListeningSocket> sockets;
    std::string line;
    std::getline(table, line); // headings
    while (std::getline(table, line)) {
        std::istringstream words(line);
        std::string slot, local, remote, state, word, inode;
        // sl local_address rem_address st, then tx_queue:rx_queue tr:tm->when retrnsmt uid timeout, then inode
        words >> slot >> local >> remote >> state;
        for (int i = 0; i < 5; ++i) words >> word;
        words >> inode;
        if (state == "0A" /* TCP_LISTEN */) sockets.push_back({local, inode});
    }
    return sockets;
}

} // namespace tandem::process
