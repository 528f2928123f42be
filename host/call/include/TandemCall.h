// SPDX-License-Identifier: Apache-2.0
// Service calls that cross a link and take long. Ours: for OPRoS components and for RTCs alike, which may use it or not. In
// calls that do not cross a link, and in those of another process by CORBA, nothing is ever said or cancelled.
#ifndef TANDEM_CALL_H_
#define TANDEM_CALL_H_

#include <chrono>
#include <memory>

namespace tandem {

// For the method or operation that is called, in the thread in which it is called.

/// Whether nobody waits for the result of the call that this thread executes: the caller has cancelled it, its deadline is
/// over, its process has ended, or this host ends. A method that takes long asks now and then, and returns if so: what it
/// returns is dropped. False in a thread that executes no call from across a link. Takes a few loads.
bool call_cancelled();

/// Says how far the call is that this thread executes: 0 to 1.
void set_call_progress(double share);

namespace call {
struct HandleState;
}

// For the component that calls.

/// Cancels calls and tells how far they are: those that are made while a CallScope of this handle is there. Copies are
/// handles of the same calls. [any-thread]
class CallHandle {
  public:
    /// `max_duration` bounds the calls instead of the link's call_timeout, within which they still have to begin; 0 means
    /// no other bound. At most 24 h.
    explicit CallHandle(std::chrono::milliseconds max_duration = std::chrono::milliseconds(0));

    /// Ends the calls of this handle, within 5 ms: they fail as cancelled, whatever the provider does. One that has not begun
    /// never begins; one that runs finds call_cancelled(). A call that has ended stays as it is, and so may one that is
    /// answered at this moment. For ever: another call needs another handle.
    void cancel();
    bool cancelled() const;

    /// What the provider of the newest call has said, 0 to 1, up to 5 ms ago; negative: nothing.
    double progress() const;

    /// Whether a call that does not wait for its reply has not ended: a oneway operation, or a non-blocking method that
    /// returns nothing.
    bool pending() const;

  private:
    friend class CallScope;
    std::shared_ptr<call::HandleState> m_state;
};

/// While it is there, the calls of this thread are those of the handle; the innermost one counts. [one thread]
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
