// SPDX-License-Identifier: Apache-2.0
#include "host/process/listening_sockets.hpp"

#include <catch2/catch.hpp>
#include <sstream>

TEST_CASE("the listening sockets of a table are read with address and inode, and others are left out") {
    std::istringstream table(
        "  sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt   uid  timeout inode\n"
        "   0: 0100007F:0AFA 00000000:0000 0A 00000000:00000000 00:00000000 00000000  1000        0 4711 1 "
        "0\n"
        "   1: 0100007F:0AFB 0100007F:1234 01 00000000:00000000 00:00000000 00000000  1000        0 4712 1 "
        "0\n"
        "\n");
    const auto sockets = tandem::process::read_listening_sockets(table);
    REQUIRE(sockets.size() == 1);
    CHECK(sockets[0].address == "0100007F:0AFA");
    CHECK(sockets[0].inode == "4711");
}
