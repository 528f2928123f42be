// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/drive/driven_rtc.hpp"

#include <memory>
#include <string>
#include <vector>

namespace tandem::interceptor {

/// The RTCs behind one link, driven together, in the order in which they were added, and deactivated in the reverse
/// order. Each function but add() returns an empty string or an error of one line. [any-thread] but add()
class RtcGroup {
  public:
    void add(std::unique_ptr<DrivenRtc> rtc) { rtcs_.push_back(std::move(rtc)); }
    /// If one cannot be activated, those that this call has activated are deactivated again.
    std::string activate();
    std::string deactivate();
    /// Resets those that are in ERROR.
    std::string reset();

  private:
    std::vector<std::unique_ptr<DrivenRtc>> rtcs_;
};

} // namespace tandem::interceptor
