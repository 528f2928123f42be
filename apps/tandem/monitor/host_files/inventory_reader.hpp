// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/state.hpp"
#include "host/process/file_descriptor.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace tandem::monitor {

/// Reads the inventories of hosts (host/process/published/inventory.hpp), without affecting the hosts. [one thread]
class InventoryReader {
  public:
    /// Looks for the inventories of a process. Returns false if it has none.
    bool look(std::uint32_t pid);
    /// Returns what the inventories of a process list. While one is being written, its previous content counts. Null if none.
    std::shared_ptr<const HostInventory> read(std::uint32_t pid);
    /// Forgets all processes but these.
    void keep(const std::vector<std::uint32_t>& pids);

  private:
    struct File {
        process::FileDescriptor file;
        std::uint64_t sequence = 0; ///< of `text`; 0: none was read
        std::string text{};
        std::uint64_t left_out = 0;
    };
    struct Process {
        std::vector<File> files{};
        std::shared_ptr<const HostInventory> inventory{};
    };
    static bool read_file(File& file);

    std::map<std::uint32_t, Process> processes_;
};

/// Adds the parts that the text of an inventory lists to `inventory`: components sorted by name, contexts by owner, ports by
/// component and name, and connections as ids of ports. Counts other lines as left out.
void parse_inventory(const std::string& text, HostInventory& inventory);

} // namespace tandem::monitor
