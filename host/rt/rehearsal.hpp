// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tandem::rt {

/// Set by Rehearsal. In static thread storage, and one for all libraries of a process, so that a check takes two
/// instructions.
extern constinit thread_local bool this_thread_rehearses [[gnu::tls_model("initial-exec")]];

/// Returns whether this thread rehearses its next cycle. A rehearsal runs the code of the cycle without its effects, so
/// that its code and data are in the caches when the tick comes: it calls no callback of a component, publishes and
/// takes no message of a port, and waits for no lock of a port. The functions where an effect would take place call this; the
/// functions on the way there do not. Figures: docs/performance.md.
inline bool rehearsing() noexcept { return this_thread_rehearses; }

/// While it exists, this thread rehearses.
class Rehearsal {
  public:
    Rehearsal() noexcept : outer_(this_thread_rehearses) { this_thread_rehearses = true; }
    ~Rehearsal() { this_thread_rehearses = outer_; }
    Rehearsal(const Rehearsal&) = delete;
    Rehearsal& operator=(const Rehearsal&) = delete;

  private:
    const bool outer_;
};

/// A connection or a port whose push() has no effect in a rehearsal. No other connection is called in a rehearsal.
class Rehearsable {
  public:
    virtual ~Rehearsable() = default;
    virtual bool can_rehearse() const { return true; }
};

} // namespace tandem::rt
