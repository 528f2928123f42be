// SPDX-License-Identifier: Apache-2.0
#ifndef COIL_NONCOPYABLE_H
#define COIL_NONCOPYABLE_H

namespace coil {

class NonCopyable {
  protected:
    NonCopyable() = default;
    ~NonCopyable() = default;

  private:
    NonCopyable(const NonCopyable&) = delete;
    NonCopyable& operator=(const NonCopyable&) = delete;
};

} // namespace coil
#endif
