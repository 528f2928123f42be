// SPDX-License-Identifier: Apache-2.0
// The files that `tandem rtm new` writes.
#pragma once

#include "apps/tandem/build/component_folder.hpp"

namespace tandem::command {

/// A component with a port in each direction and a parameter, an rtc.conf that runs it, and its CMakeLists.txt.
TemplateFiles rt_component_template(const std::string& name);

} // namespace tandem::command
