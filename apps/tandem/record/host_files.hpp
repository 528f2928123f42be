// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/writer.hpp"

#include <cstdint>
#include <string>

namespace tandem::command {

/// Stores the command line of each host of the link as metadata, and the files that it names (application
/// profiles, rtc.conf), up to 1 MiB each, as attachments. Skips unreadable files.
void store_host_files(mcap::McapWriter& writer, const std::string& link, std::uint64_t generation);

/// Stores the port tables of both sides as metadata `tandem.ports`. A replay publishes the table of the
/// side that it replaces.
void store_port_tables(mcap::McapWriter& writer, const std::string& link, std::uint64_t generation);

} // namespace tandem::command
