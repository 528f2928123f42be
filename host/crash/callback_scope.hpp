// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>

namespace tandem::crash {

/// A callback of a component that has not returned yet.
struct RunningCallback {
    const char* component; ///< the component's name
    const char* name;      ///< of the callback, as in `onActivated`
    const void* code;      ///< an address inside the component's library; NULL: not known
    std::chrono::steady_clock::time_point since; ///< to 4 ms
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - since).count();
    }
};

/// The texts of a RunningCallback, for readers outside the process; too long ones are cut. In no callback: empty.
struct CallbackText {
    char component[80];
    char callback[48];
};

/// While it lives, the innermost callback of the calling thread stands in `text`, which its scopes write. NULL: in none.
/// One in a thread at a time. [any-thread]
class CallbackPublication {
  public:
    explicit CallbackPublication(CallbackText* text);
    ~CallbackPublication();
    CallbackPublication(const CallbackPublication&) = delete;
    CallbackPublication& operator=(const CallbackPublication&) = delete;

  private:
    struct ThreadCallbacks& thread_;
};

/// While it lives, the calling thread is in a callback of a component: for the report of a crash, and to name a callback
/// that does not return. The scopes of a thread nest: the end of one returns to the outer one. Some stores; the first
/// scope of a thread allocates and gives the thread its alternate signal stack. [any-thread]
class CallbackScope {
  public:
    /// `component` is an address that names the component for find_running_callback(), and is never dereferenced; NULL:
    /// it cannot be found. The texts live as long as the scope, or, if it can be found, as long as the component.
    CallbackScope(const void* component, const char* component_name, const char* callback, const void* code);
    ~CallbackScope();
    CallbackScope(const CallbackScope&) = delete;
    CallbackScope& operator=(const CallbackScope&) = delete;

  private:
    struct ThreadCallbacks& thread_;
};

/// The innermost callback of this thread. [async-signal-safe]
std::optional<RunningCallback> running_callback();

/// The callback that the component is in; of several threads, the one that has been in it longest, and of nested ones
/// the innermost. Exact for a callback that lasts; one that begins or ends at this moment may be missed. [any-thread]
std::optional<RunningCallback> find_running_callback(const void* component);

} // namespace tandem::crash
