// SPDX-License-Identifier: Apache-2.0
// A scenario with its settings and its name, for tests that run many.
#pragma once
#include "tests/shm/model/checker/model.hpp"

namespace tandem::shm::model {

struct Case {
    const char* name;
    Scenario scenario;
    Settings settings = {};
    bool small = false; ///< a search of it is complete in the default size of a test
};

} // namespace tandem::shm::model
