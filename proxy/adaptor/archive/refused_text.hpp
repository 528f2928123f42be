// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <archive/opros_archive_common.h>

namespace tandem::adaptor {

/// A text that CORBA's strings cannot hold. what() says why.
class RefusedText final : public opros::archive::archive_type_exception {
  public:
    static RefusedText with_nul() { return RefusedText("a string contains a NUL"); }
    static RefusedText beyond_16_bits() { return RefusedText("a wide character is beyond U+FFFF"); }
    const char* what() const noexcept override { return why_; }

  private:
    explicit RefusedText(const char* why) : why_(why) {}

    const char* why_;
};

} // namespace tandem::adaptor
