// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tandem::interceptor {

/// The component model of InterceptorComp's side, in its port table (link::PortTable::model).
inline constexpr const char* model = "RTM";

} // namespace tandem::interceptor
