// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace tandem::engine {

struct AbsentProperty {
    std::string name;
    bool misspelt;    ///< the component has a property with a similar name
    std::string line; ///< for the log
};

/// Records, from now on, each property that a component requests by getProperty() and does not have: once for each
/// component and name, with the most similar name that the component has. With `log`, also logs a line. [main-thread]
void watch_absent_properties(bool log);

/// Returns the properties recorded so far. [any-thread]
std::vector<AbsentProperty> absent_properties();

} // namespace tandem::engine
