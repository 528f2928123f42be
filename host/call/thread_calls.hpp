// SPDX-License-Identifier: Apache-2.0
// The calls of a thread, for the proxy, which sets the call that a thread executes and reads the handle for the calls that the
// thread makes.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

namespace tandem::call {

/// What a CallHandle and its calls share.
struct HandleState {
    explicit HandleState(std::uint64_t bound_ns) : max_ns(bound_ns) {}

    std::atomic<bool> cancelled{false};
    std::atomic<double> progress{-1};
    std::atomic<int> pending{0}; ///< calls without a waiting caller
    const std::uint64_t max_ns;  ///< time limit of each call, in ns; 0: the default one
};
using SharedHandle = std::shared_ptr<HandleState>;

/// Returns the handle of the calls that this thread makes, valid in its scope; nullptr: there is none.
const SharedHandle* handle_of_thread();

/// Replaces that handle. Returns the previous one.
const SharedHandle* exchange_handle_of_thread(const SharedHandle* handle);

/// The call that a thread executes, if it executes one at this moment.
class ExecutedCall {
  public:
    virtual ~ExecutedCall() = default;
    virtual bool cancelled() const = 0;
    virtual void set_progress(double share) = 0;
};

/// The object that call_cancelled() and set_call_progress() of this thread use; nullptr: none. It is set once for each thread,
/// so that a call costs nothing more.
void set_executed_call(ExecutedCall* call);

} // namespace tandem::call
