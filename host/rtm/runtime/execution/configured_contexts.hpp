// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <coil/Properties.h>
#include <vector>

namespace RTC {

/// Returns the execution contexts that a component with these properties owns, each as the properties for
/// ExecutionContextBase::init(), with `type` and, if it has one, `name`. The property `execution_contexts`
/// lists them (`type(name), ...`, or `none`); without it there is one, of the type `exec_cxt.periodic.type`.
/// Options come from `exec_cxt`, `ec.<type>` and `ec.<name>`; the later win. Throws ManagerError for a
/// malformed list.
std::vector<coil::Properties> configured_contexts(const coil::Properties& component);

} // namespace RTC
