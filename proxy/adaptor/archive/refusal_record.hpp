// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <string>

namespace tandem::adaptor {

/// Remembers the first connection that a mirror has refused. A base class of mirrors. [any-thread]
class RefusalRecord {
  public:
    RefusalRecord() = default;
    virtual ~RefusalRecord() = default;
    RefusalRecord(const RefusalRecord&) = delete;
    RefusalRecord& operator=(const RefusalRecord&) = delete;

    /// Returns the reason of the first refused connection; empty if none was refused.
    std::string first_refusal() const {
        const std::lock_guard lock(refusal_mutex_);
        return first_refusal_;
    }

  protected:
    /// Remembers the reason if it is the first one; an empty reason is none.
    void record_refusal(const std::string& reason) {
        const std::lock_guard lock(refusal_mutex_);
        if (first_refusal_.empty()) first_refusal_ = reason;
    }

  private:
    mutable std::mutex refusal_mutex_;
    std::string first_refusal_;
};

} // namespace tandem::adaptor
