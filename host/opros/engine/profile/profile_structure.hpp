// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/xml_file.hpp"

namespace tandem::engine {

/// Returns a line with file and line number for each element that a profile contains and that has no effect: an element
/// in another place than the engine reads it from, a value in an attribute or a child element, an empty number, and all
/// but one of several elements or properties of the same name. At most 100 lines. The profile works without them, so
/// none is thrown.
std::vector<std::string> find_structure_errors(const XmlFile& xml);

} // namespace tandem::engine
