// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <coil/Logger.h>
#include <mutex>
#include <string>
#include <utility>

namespace testing {

/// The lines of the log that contain `part`.
class LogLines : public coil::LogStreamBuffer {
  public:
    explicit LogLines(std::string part) : part_(std::move(part)) {}
    void write(int, const std::string& name, const std::string&, const std::string& message) override {
        if (message.find(part_) == std::string::npos) return;
        const std::lock_guard<std::mutex> lock(mutex_);
        text_ += name + ": " + message + "\n";
    }
    std::string get() {
        const std::lock_guard<std::mutex> lock(mutex_);
        return text_;
    }

  private:
    const std::string part_;
    std::mutex mutex_;
    std::string text_;
};

} // namespace testing
