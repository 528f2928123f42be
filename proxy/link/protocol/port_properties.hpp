// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"
#include "shm/segment/side.hpp"

#include <string>
#include <vector>

namespace tandem::link {

/// A line for each of these settings that is one of a port, as `names.PORT`, and would have no effect, which nobody would
/// notice: the RTCs of the table do not have the port, or the setting is the other side's. They are properties of
/// AdaptorComp, the first side, or parameters of InterceptorComp. The lines name the ports that there are.
std::vector<std::string> find_properties_without_port(const std::vector<std::string>& properties,
                                                      const PortTable& table,
                                                      shm::Side side = shm::Side::first);

/// Whether engines give the property to each component: opros.component.dir, _opros_xx_internal_xx_Component_Path.
bool is_set_by_engine(const std::string& property);

/// A line for each of AdaptorComp's properties that it does not know.
std::vector<std::string> find_unknown_properties(const std::vector<std::string>& properties);
/// A line for each of InterceptorComp's parameters that looks like one of its own and is none: it is called like those of a
/// port, and ends with the name of one. What else an RTC has is its manager's.
std::vector<std::string> find_unknown_parameters(const std::vector<std::string>& parameters,
                                                 const PortTable& table);

} // namespace tandem::link
