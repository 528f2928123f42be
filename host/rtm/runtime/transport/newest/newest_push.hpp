// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>
#include <memory>
#include <optional>
#include <rtm/ByteData.h>
#include <rtm/DataPortStatus.h>
#include <rtm/RTC.h>

namespace RTC {

/// The receiving end of a NewestPush. Calls may overlap.
class NumberedReceiver {
  public:
    virtual ~NumberedReceiver() = default;
    /// Like RemoteReceiver::put(). The receiver skips a message unless its number is greater than all numbers received
    /// before. [any-thread]
    virtual std::optional<DataPortStatus> put(std::uint64_t number, const ByteData& bytes) = 0;

    /// Returns the receiver that the InPort has published, if it is on another machine, because only a network makes
    /// calls overlap. Otherwise returns NULL.
    static std::unique_ptr<NumberedReceiver> find(const ConnectorProfile& profile,
                                                  std::chrono::milliseconds answer_timeout);
};

/// Sends to another machine. A message that the network holds back, because TCP must repeat it, does not hold up later
/// messages: each call has a separate thread and TCP connection. While all of them wait, only the newest message is
/// kept. A fast network needs only one thread. [one writer at a time]
class NewestPush {
  public:
    /// Maximum number of simultaneous calls. Ten fill a round trip of 100 ms every 10 ms; the others wait for lost
    /// packets.
    static constexpr unsigned max_calls = 16;

    explicit NewestPush(std::unique_ptr<NumberedReceiver> receiver);
    /// Does not wait: calls in progress end in their threads.
    ~NewestPush();
    NewestPush(const NewestPush&) = delete;
    NewestPush& operator=(const NewestPush&) = delete;

    /// Does not wait. Returns the answer to the newest answered message: PORT_OK before the first answer, SEND_TIMEOUT
    /// if there was no answer in time. Always returns CONNECTION_LOST once the receiver no longer exists.
    DataPortStatus write(const ByteData& bytes);

  private:
    struct Calls;
    std::shared_ptr<Calls> calls_; // shared with the threads
};

} // namespace RTC
