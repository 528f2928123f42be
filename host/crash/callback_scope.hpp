// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <optional>

namespace tandem::crash {

/// A component's callback that has not returned yet.
struct RunningCallback {
    const char* component;                       ///< the component's name
    const char* name;                            ///< of the callback, for example `onActivated`
    const char* port;                            ///< the port in which the call has come; NULL: none
    const void* code;                            ///< an address inside the component's library; NULL: unknown
    std::chrono::steady_clock::time_point since; ///< resolution: 4 ms
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - since).count();
    }
};

/// The texts of a RunningCallback, for readers in other processes. Long texts are truncated. `callback` is empty
/// while no callback runs.
struct CallbackText {
    char component[80];
    char callback[48];
};

/// During its lifetime, the scopes of the calling thread write the thread's innermost callback to `text`. NULL: to
/// nowhere. At most one per thread. [any-thread]
class CallbackPublication {
  public:
    explicit CallbackPublication(CallbackText* text);
    ~CallbackPublication();
    CallbackPublication(const CallbackPublication&) = delete;
    CallbackPublication& operator=(const CallbackPublication&) = delete;

  private:
    struct ThreadCallbacks& thread_;
};

/// During its lifetime, the calling thread is in a component's callback. Used for crash reports and to name a
/// callback that does not return. Scopes of a thread nest. Costs a few stores. The first scope of a thread allocates
/// memory and gives the thread its alternate signal stack. [any-thread]
class CallbackScope {
  public:
    /// `component` is an address that identifies the component for find_running_callback() and is never dereferenced.
    /// With NULL, the scope cannot be found. The texts must live as long as the scope, or as long as the component if
    /// the scope can be found.
    CallbackScope(const void* component, const char* component_name, const char* callback, const void* code);
    ~CallbackScope();
    CallbackScope(const CallbackScope&) = delete;
    CallbackScope& operator=(const CallbackScope&) = delete;

  private:
    struct ThreadCallbacks& thread_;
};

/// During its lifetime, the innermost scope of the calling thread is a call of this port. Create it directly after a
/// CallbackScope, in the same block. The text must live as long as the scope. [any-thread]
class PortScope {
  public:
    explicit PortScope(const char* port);
    ~PortScope();
    PortScope(const PortScope&) = delete;
    PortScope& operator=(const PortScope&) = delete;

  private:
    std::atomic<const char*>* port_; ///< null: the scope is too deep to be recorded
};

/// Returns the innermost callback of this thread. [async-signal-safe]
std::optional<RunningCallback> running_callback();

/// Returns the component's running callback: of several threads, the longest running one; of nested callbacks, the
/// innermost. Exact for a lasting callback, but may miss one that begins or ends at this moment. [any-thread]
std::optional<RunningCallback> find_running_callback(const void* component);

} // namespace tandem::crash
