// SPDX-License-Identifier: Apache-2.0
// Components of OPRoS v1 name boost::any, the type on its data ports. They get opros_any, unless they include Boost
// itself: names of namespace boost are found first. Ours: part of OPRoSTypes.h.
#ifndef OPROS_BOOST_NAMES_H_
#define OPROS_BOOST_NAMES_H_

#include <OPRoSAny.h>

namespace opros {
namespace boost_names {

typedef ::opros_any any;
template <typename T>
T* unsafe_any_cast(any* operand) {
    return unsafe_opros_any_cast<T>(operand);
}
template <typename T>
T* any_cast(any* operand) {
    return opros_any_cast<T>(operand);
}
template <typename T>
T any_cast(any& operand) {
    return opros_any_cast<T>(operand);
}

} // namespace boost_names
} // namespace opros

namespace boost {
using namespace opros::boost_names;
}

#endif
