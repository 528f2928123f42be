// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace opros::archive {

/// Returns true if the C++ type name is that of a std::pair. The text format writes the entries of a map as
/// alternating keys and values, without a pair around them.
inline bool is_pair_type(const std::string& name) { return name.rfind("std::pair<", 0) == 0; }

} // namespace opros::archive
