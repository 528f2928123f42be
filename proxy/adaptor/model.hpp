// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tandem::adaptor {

/// The component model of AdaptorComp's side, in its port table (link::PortTable::model).
inline constexpr const char* model = "OPRoS";

} // namespace tandem::adaptor
