// SPDX-License-Identifier: Apache-2.0
// Progress and cancellation of long service calls across a link. Ours: OPRoS components and RTCs may use it. It has no effect
// on calls that do not cross a link, or that go to another process by CORBA.
#ifndef TANDEM_CALL_H_
#define TANDEM_CALL_H_

#include <chrono>
#include <memory>

namespace tandem {

// For the method or operation that is called, in the thread in which it runs.

/// Returns whether the result of the call that this thread executes is no longer needed: the caller has cancelled it, its
/// deadline has passed, the caller's process has ended, or this host is ending. A long method should check this from time to
/// time and return; its result is dropped. Returns false in a thread that executes no call from a link. Takes a few loads.
bool call_cancelled();

/// Reports the progress of the call that this thread executes: 0 to 1.
void set_call_progress(double share);

namespace call {
struct HandleState;
}

// For the component that calls.

/// Cancels calls and shows their progress: the calls that are made while a CallScope of this handle exists. A copy is a handle
/// of the same calls. [any-thread]
class CallHandle {
  public:
    /// `max_duration`: replaces the link's call_timeout as the bound of each call, at most 24 h; 0: keeps call_timeout. A call
    /// must still begin within call_timeout.
    explicit CallHandle(std::chrono::milliseconds max_duration = std::chrono::milliseconds(0));

    /// Ends the calls of this handle within 5 ms: they fail as cancelled, whatever the provider does. A call that has not begun
    /// never begins. In a call that runs, call_cancelled() returns true. Has no effect on a call that has ended, and perhaps
    /// none on one that is answered at this moment. The handle stays cancelled: use another one for further calls.
    void cancel();
    bool cancelled() const;

    /// Returns the progress that the provider of the newest call has reported, 0 to 1, up to 5 ms old; negative: none yet.
    double progress() const;

    /// Returns whether a call that does not wait for its reply is still running: a oneway operation, or a non-blocking
    /// method without a result.
    bool pending() const;

  private:
    friend class CallScope;
    std::shared_ptr<call::HandleState> m_state;
};

/// While it exists, calls of this thread belong to the handle. If scopes are nested, the innermost one counts. [one thread]
class CallScope {
  public:
    explicit CallScope(const CallHandle& handle);
    ~CallScope();
    CallScope(const CallScope&) = delete;
    CallScope& operator=(const CallScope&) = delete;

  private:
    const std::shared_ptr<call::HandleState> m_state;
    const std::shared_ptr<call::HandleState>* const m_outer;
};

} // namespace tandem

#endif
