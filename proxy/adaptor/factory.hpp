// SPDX-License-Identifier: Apache-2.0
// Makes AdaptorComp for the plugin, which so needs none of its headers.
#pragma once

class Component;

namespace tandem::adaptor {

/// A new AdaptorComp, for delete_adaptor().
Component* create_adaptor();
void delete_adaptor(Component* component);

} // namespace tandem::adaptor
