// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rtm/runtime/transport/call/call_segment.hpp"

namespace RTC {

/// The threads that execute the calls of one segment. There is one at first. Whenever the last idle thread takes a call,
/// another one starts, up to twice max_shared_calls, so that calls within calls, also within oneway ones, cannot block each
/// other. Two threads are kept.
class CallWorkers {
  public:
    /// Executes calls of `object`, which is in this process. Throws tandem::shm::Error if the process cannot create a
    /// thread.
    CallWorkers(CallSegment segment, CORBA::Object_ptr object);
    /// Refuses further calls. Does not wait for those that are being executed, which are still answered.
    ~CallWorkers();
    CallWorkers(const CallWorkers&) = delete;
    CallWorkers& operator=(const CallWorkers&) = delete;

  private:
    struct State;
    const std::shared_ptr<State> state_; // the threads have it, too
};

} // namespace RTC
