// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "proxy/link/protocol/port_table.hpp"
#include "proxy/wire/type.hpp"
#include "shm/inspect/observer.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace tandem::command {

/// A data port whose messages cross a link, as the side that has it describes it.
struct FollowedPort {
    link::Port port;
    shm::Side owner{};  ///< whose port it is
    shm::Side writer{}; ///< who sends
    wire::Type message{};
    bool timed = false; ///< the message begins with RTM's time, which crosses in the record's stamp
};

/// A message of that port as its side's model has it, in CDR: with the time in front, if it is timed.
void append_message(const FollowedPort& port, std::span<const std::byte> bytes, std::uint64_t stamp,
                    std::vector<std::byte>& out);

/// The data ports of the port tables in an observation, in their order; of both sides. What is wrong with a table is left
/// out: its ports cannot be decoded.
std::vector<FollowedPort> find_ports(const shm::Observation& observation);

} // namespace tandem::command
