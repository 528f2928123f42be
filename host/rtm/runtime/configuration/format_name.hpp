// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <coil/Properties.h>
#include <string>

namespace RTC {

/// Expands a format of `naming.formats`, `manager.naming_formats` or `logger.file_name`: %n instance name,
/// %t or %m type name, %i implementation id, %N the number at the end of the instance name, %v version,
/// %V vendor, %c category (from `component`); %h host, %M manager, %p process id (from `config`); $NAME and
/// ${NAME} environment variables. Any other character after % stands for itself.
std::string format_name(const std::string& format, const coil::Properties& component,
                        const coil::Properties& config);

} // namespace RTC
