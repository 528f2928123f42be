// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace tandem::adaptor {

/// Returns true if engines set this property for each component: opros.component.dir,
/// _opros_xx_internal_xx_Component_Path.
inline bool is_set_by_engine(std::string_view property) {
    return property.starts_with("opros.") || property.starts_with("_opros_");
}

} // namespace tandem::adaptor
