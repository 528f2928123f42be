// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <condition_variable>
#include <functional>
#include <memory>
#include <rtm/CdrRingBuffer.h>
#include <rtm/ConnectorBase.h>
#include <thread>

namespace RTC {

/// A thread between a writer and a slow receiver (subscription types new and periodic). Properties:
/// `push_policy` all | fifo | skip | new (new), `skip_count`, `push_rate` (Hz, periodic), `buffer.*`.
class Publisher {
  public:
    using Deliver = std::function<DataPortStatus(ByteData&)>;
    /// NULL for the subscription type flush, which needs none.
    static std::unique_ptr<Publisher> create(const coil::Properties& properties, Deliver deliver);
    Publisher(const coil::Properties& properties, bool periodic, Deliver deliver);
    ~Publisher();

    DataPortStatus write(const ByteData& bytes);
    CdrBufferBase& buffer() { return buffer_; }

  private:
    enum class Policy { all, fifo, skip, newest };
    void run();
    void push();

    Deliver deliver_;
    CdrRingBuffer buffer_;
    Policy policy_ = Policy::newest;
    unsigned skip_count_ = 0;
    unsigned skipped_ = 0;
    std::chrono::nanoseconds period_{0}; // 0: at each write
    std::mutex mutex_;
    std::condition_variable wake_;
    bool written_ = false;
    bool stopping_ = false;
    std::atomic<bool> connection_lost_{false};
    std::thread thread_;
};

} // namespace RTC
