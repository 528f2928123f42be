// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/writer.hpp"

#include <cstdint>
#include <string>

namespace tandem::command {

/// Stores with a recording what runs: the command line of each host of the link as metadata, and the files that it names
/// (application profiles, rtc.conf), up to 1 MiB each, as attachments. What cannot be read is left out.
void store_host_files(mcap::McapWriter& writer, const std::string& link, std::uint64_t generation);

/// Stores the port tables of both sides as metadata `tandem.ports`: a replay publishes that of the side whose place it takes.
void store_port_tables(mcap::McapWriter& writer, const std::string& link, std::uint64_t generation);

} // namespace tandem::command
