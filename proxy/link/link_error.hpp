// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

namespace tandem::link {

/// The two halves cannot work together; what() is one line with link, port, expectation and remedy.
class LinkError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

} // namespace tandem::link
