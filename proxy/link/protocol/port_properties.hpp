// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"
#include "shm/segment/side.hpp"

#include <string>
#include <vector>

namespace tandem::link {

/// Returns a line for each setting of a port, such as `names.PORT`, that has no effect, because the RTCs of the table
/// do not have this port or the setting belongs to the other side. The settings are properties of AdaptorComp (the
/// first side) or parameters of InterceptorComp. The lines list the existing ports.
std::vector<std::string> find_properties_without_port(const std::vector<std::string>& properties,
                                                      const PortTable& table,
                                                      shm::Side side = shm::Side::first);

/// Returns true if engines set this property for each component: opros.component.dir,
/// _opros_xx_internal_xx_Component_Path.
bool is_set_by_engine(const std::string& property);

/// Returns a line for each property that AdaptorComp does not know.
std::vector<std::string> find_unknown_properties(const std::vector<std::string>& properties);
/// Returns a line for each parameter that looks like one of InterceptorComp's but is not: its name resembles a port
/// parameter and ends with the name of a port. All other parameters of an RTC belong to its manager.
std::vector<std::string> find_unknown_parameters(const std::vector<std::string>& parameters,
                                                 const PortTable& table);

} // namespace tandem::link
