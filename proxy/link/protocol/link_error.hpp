// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

namespace tandem::link {

/// The two sides of a link cannot work together, or a side has published unreadable data. what() is one line that
/// names the link or port, what was expected and what to do.
class LinkError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

} // namespace tandem::link
