// SPDX-License-Identifier: Apache-2.0
// Creates AdaptorComp for the plugin, so that the plugin needs none of its headers.
#pragma once

class Component;

namespace tandem::adaptor {

/// Returns a new AdaptorComp, to be deleted by delete_adaptor().
Component* create_adaptor();
void delete_adaptor(Component* component);

} // namespace tandem::adaptor
