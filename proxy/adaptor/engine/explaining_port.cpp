// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/engine/explaining_port.hpp"

#include "proxy/adaptor/engine/capabilities.hpp"

#include <spdlog/spdlog.h>

namespace tandem::adaptor::engine {

void report_type_error(const std::string& line) {
    if (!has_extensions) spdlog::error("{}", line);
}

} // namespace tandem::adaptor::engine
