// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/process/published/notices.hpp"
#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>
#include <rtm/ConnectorBase.h>
#include <rtm/DataPortStatus.h>
#include <rtm/RTC.h>
#include <string>

namespace RTC {

/// Evaluates the results of calls to one object. Logs when another machine stops answering, and when it answers again,
/// in one line each, and shows the silence to observers. Calls may overlap. [any-thread]
class PeerAnswers {
  public:
    using Time = std::chrono::steady_clock::time_point;
    explicit PeerAnswers(CORBA::Object_ptr object);

    bool is_on_another_machine() const { return !other_machine_.empty(); }
    /// Call it when a call begins.
    Time now() const { return is_on_another_machine() ? std::chrono::steady_clock::now() : Time(); }
    void answered();
    /// Returns the outcome of a call that has thrown `e`, as RemoteReceiver::put() returns it.
    std::optional<DataPortStatus> failed(const CORBA::SystemException& e, Time begun);

  private:
    void log_silence(Time begun);

    CORBA::Object_var object_;
    const std::string other_machine_; // its address; empty: this one
    std::atomic<Time> answered_at_{Time()};
    std::atomic<bool> is_silent_{false}; // changed with the mutex held
    std::mutex mutex_;
    unsigned unanswered_ = 0;                          // guarded by the mutex
    std::optional<tandem::process::OwnNotice> notice_; // guarded by the mutex; while the machine is silent
};

/// Logs in one line that the peer of a connection answers with errors: its own log need not say so. One caller at a time.
class PeerErrors {
  public:
    /// `peer`: receiver or sender. Logs the first error other than a lost connection, which others report.
    void note(const ConnectorInfo& connection, const char* peer, DataPortStatus status);

  private:
    bool has_logged_ = false;
};

} // namespace RTC
