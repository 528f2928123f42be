// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/typed/added_types.hpp"

#ifdef TANDEM_OPROS_TYPES
#include TANDEM_OPROS_TYPES
#else
namespace tandem::adaptor {

using AddedValues = Values<>;
using AddedMethods = Methods<>;

} // namespace tandem::adaptor
#endif

namespace tandem::adaptor {

void add_users_values(ValueTypes& types) { AddedValues::add_to(types); }
void add_users_methods(MethodTypes& types) { AddedMethods::add_to(types); }

} // namespace tandem::adaptor
