// SPDX-License-Identifier: Apache-2.0
// The files that `tandem opros new` writes.
#pragma once

#include "apps/tandem/build/component_folder.hpp"

namespace tandem::command {

/// Returns a component with an input, an output and a property, its profile, an application, and a CMakeLists.txt.
TemplateFiles opros_component_template(const std::string& name);

} // namespace tandem::command
