// SPDX-License-Identifier: Apache-2.0
// The type is the library's own, and gone with it.
#include "tests/host/plugin/zoo/entry.hpp"
#include <exception>
namespace {
class NoArm : public std::exception {
  public:
    const char* what() const noexcept override { return "the arm is missing"; }
};
} // namespace
ZOO_ENTRY { throw NoArm(); }
