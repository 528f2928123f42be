// SPDX-License-Identifier: Apache-2.0
#ifndef OPROS_OARCHIVE_FWD_H
#define OPROS_OARCHIVE_FWD_H

namespace opros {
namespace archive {
class oarchive;
} // namespace archive
} // namespace opros

#endif
