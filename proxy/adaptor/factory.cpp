// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/factory.hpp"

#include "proxy/adaptor/adaptor_comp.hpp"

namespace tandem::adaptor {

Component* create_adaptor() { return new AdaptorComp(); }
void delete_adaptor(Component* component) { delete component; }

} // namespace tandem::adaptor
