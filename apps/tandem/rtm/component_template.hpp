// SPDX-License-Identifier: Apache-2.0
// The texts of a new RT-Component; @NAME@ stands for its name.
#pragma once

#include "apps/tandem/build/component_folder.hpp"

namespace tandem::command {

TemplateFiles rt_component_template(const std::string& name);

} // namespace tandem::command
