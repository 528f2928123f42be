// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tandem::link {

/// A setting of single ports, `NAME.PORT`: `wait_ms.goal`.
struct PortSetting {
    enum class Of : std::uint8_t { this_side, sender, receiver };
    std::string_view name;
    const char* ports; ///< the word for its ports in messages
    bool (*is_for)(const Port&);
    Of of = Of::this_side; ///< the side on which it has an effect
};

inline bool has_data(const Port& port) { return is_data_port(port.kind); }

/// The settings that the channels of a link have: see read_port_policy(). Each proxy has them.
inline constexpr PortSetting keep_last_setting{"keep_last", "data port", has_data, PortSetting::Of::sender},
    wait_ms_setting{"wait_ms", "data port", has_data, PortSetting::Of::sender},
    deadline_ms_setting{"deadline_ms", "data port", has_data, PortSetting::Of::receiver};

/// The settings of ports that a proxy has.
struct PortSettings {
    const char* word;       ///< of the model for a setting: property, parameter
    const char* peer_proxy; ///< named in the remedy
    bool owns_ports;        ///< the ports of the tables that it checks are on its own side, not on the peer's
    std::span<const PortSetting> all;

    /// Returns the setting that `name` sets for a port; nullptr if there is none.
    const PortSetting* find(std::string_view name) const;
};

/// Returns a line for each setting of a port that has no effect, because the table does not have this port or because
/// the setting belongs to the other side. The lines list the existing ports. Ignores names that are not settings of ports.
std::vector<std::string> find_settings_without_port(const std::vector<std::string>& names,
                                                    const PortTable& table, const PortSettings& settings);

} // namespace tandem::link
