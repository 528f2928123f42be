// SPDX-License-Identifier: Apache-2.0
// The files that `tandem rtm new` writes.
#pragma once

#include "apps/tandem/build/component_folder.hpp"

namespace tandem::command {

/// Returns a component with an InPort, an OutPort and a parameter, an rtc.conf that runs it, and a CMakeLists.txt.
TemplateFiles rt_component_template(const std::string& name);

} // namespace tandem::command
