// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_DIRECTPORTBASE_H
#define RTC_DIRECTPORTBASE_H

namespace RTC {

class DirectPortBase {
  public:
    virtual ~DirectPortBase() = default;
};

} // namespace RTC
#endif
