// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace tandem::engine {

struct AbsentProperty {
    std::string name;
    bool misspelt;    ///< the component has another one of nearly that name
    std::string line; ///< for the log
};

/// From now on a property that a component asks for by getProperty() and does not have is noted, once for each
/// component and name, with the nearest name that it has. `log`: also as a line in the log. [main-thread]
void watch_absent_properties(bool log);

/// Those noted so far. [any-thread]
std::vector<AbsentProperty> absent_properties();

} // namespace tandem::engine
