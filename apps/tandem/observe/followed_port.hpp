// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "proxy/link/protocol/port_table.hpp"
#include "proxy/wire/type.hpp"
#include "shm/inspect/observer.hpp"

#include <array>
#include <cstddef>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace tandem::command {

/// A data port whose messages cross a link, as described by its side.
struct FollowedPort {
    link::Port port;
    shm::Side owner{};  ///< the side that has the port
    shm::Side writer{}; ///< the side that sends
    wire::Type message{};
    bool timed = false; ///< the message begins with RTM's time, which is sent in the record's stamp
};

/// Appends a message of the port to `out`, as CDR in the form that the model of the port's side uses. A timed message
/// then begins with its time.
void append_message(const FollowedPort& port, std::span<const std::byte> bytes, std::uint64_t stamp,
                    std::vector<std::byte>& out);

/// Returns the data ports of both sides' port tables in an observation, in order. Skips damaged entries,
/// because their ports cannot be decoded.
std::vector<FollowedPort> find_ports(const shm::Observation& observation);

/// The names of all ports of a link, including service ports.
struct PortNames {
    std::set<std::string> names{};
    int tables = 0; ///< number of sides whose port table is there
};

/// Returns the names that are in either side's port table. Skips damaged tables and tables that are being changed.
PortNames find_port_names(const shm::Observation& observation);

/// The component models of both sides, by shm::index_of(). Empty: unknown.
using Models = std::array<std::string, 2>;

/// Returns the models that both sides' port tables in an observation name. A side without a readable table keeps the model
/// of `known`.
Models find_models(const shm::Observation& observation, Models known);

} // namespace tandem::command
