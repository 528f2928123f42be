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
    /// As RemoteReceiver::put(). The receiver skips a message whose number is not greater than that of each one that it has. [any-thread]
    virtual std::optional<DataPortStatus> put(std::uint64_t number, const ByteData& bytes) = 0;

    /// What the InPort has published for it, if that is on another machine: a network alone makes calls overlap. Otherwise NULL.
    static std::unique_ptr<NumberedReceiver> find(const ConnectorProfile& profile,
                                                  std::chrono::milliseconds answer_timeout);
};

/// Sends to another machine such that a message that the network holds back, since TCP must repeat it, holds up no later one: each call
/// has a thread and a TCP connection of its own, and while all of them wait only the newest message does. A quick network needs one.
/// [one writer at a time]
class NewestPush {
  public:
    /// Calls at the same time, at most: ten fill a round trip of 100 ms every 10 ms, the others wait for packets that were lost.
    static constexpr unsigned max_calls = 16;

    explicit NewestPush(std::unique_ptr<NumberedReceiver> receiver);
    /// Does not wait: calls under way end in their threads.
    ~NewestPush();
    NewestPush(const NewestPush&) = delete;
    NewestPush& operator=(const NewestPush&) = delete;

    /// Does not wait. The answer is that of the newest message which has one: PORT_OK until then, SEND_TIMEOUT when there was none in
    /// time, CONNECTION_LOST, from then on, when the receiver is gone.
    DataPortStatus write(const ByteData& bytes);

  private:
    struct Calls;
    std::shared_ptr<Calls> calls_; // shared with the threads
};

} // namespace RTC
