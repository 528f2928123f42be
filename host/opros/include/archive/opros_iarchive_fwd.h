// SPDX-License-Identifier: Apache-2.0
#ifndef OPROS_IARCHIVE_FWD_H
#define OPROS_IARCHIVE_FWD_H

namespace opros {
namespace archive {
class iarchive;
} // namespace archive
} // namespace opros

#endif
