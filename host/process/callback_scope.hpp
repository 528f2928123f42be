// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>

namespace tandem::process {

/// A callback of a component that has not returned yet.
struct RunningCallback {
    const char* name; ///< static text, as in `onActivated`
    std::chrono::steady_clock::time_point since;
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - since).count();
    }
};

/// While it lives, the calling thread is in a callback of a component. The scopes of a thread nest: the end of one
/// returns to the outer one. Allocates in the first scope of a thread only, and takes no lock after that.
class CallbackScope {
  public:
    /// `component` is an address that names it for find_running_callback(), and is never dereferenced; `callback` is a
    /// text that lives as long as the scope.
    CallbackScope(const void* component, const char* callback);
    ~CallbackScope();
    CallbackScope(const CallbackScope&) = delete;
    CallbackScope& operator=(const CallbackScope&) = delete;
};

/// The callback that the component is in; of several threads, the one that has been in it longest, and of nested ones
/// the innermost. Exact for a callback that lasts; one that begins or ends at this moment may be missed. [any-thread]
std::optional<RunningCallback> find_running_callback(const void* component);

} // namespace tandem::process
