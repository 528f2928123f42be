// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/engine/explaining_port.hpp"

#include "host/log/log.hpp"
#include "proxy/adaptor/engine/capabilities.hpp"

namespace tandem::adaptor::engine {

void report_type_error(const std::string& line) {
    if (!has_extensions) log::error("{}", line);
}

} // namespace tandem::adaptor::engine
