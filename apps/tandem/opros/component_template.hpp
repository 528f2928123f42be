// SPDX-License-Identifier: Apache-2.0
// The texts of a new component; @NAME@ stands for its name.
#pragma once

#include "apps/tandem/build/component_folder.hpp"

namespace tandem::command {

TemplateFiles opros_component_template(const std::string& name);

} // namespace tandem::command
