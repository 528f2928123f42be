// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tandem::crash {

/// What a thread runs of a component. A null pointer: not known.
struct RunningCallback {
    const char* component = nullptr;
    const char* callback = nullptr;
    const void* code = nullptr; ///< an address inside the component's library
};

/// Names what this thread runs of a component while the object lives, for the report of a crash. Scopes nest: the
/// innermost one counts. The texts must live as long. A few stores, but for the first scope of a thread, which gives
/// the thread its alternate signal stack. [any-thread]
class CallbackScope {
  public:
    CallbackScope(const char* component, const char* callback, const void* code);
    ~CallbackScope();
    CallbackScope(const CallbackScope&) = delete;
    CallbackScope& operator=(const CallbackScope&) = delete;

  private:
    RunningCallback outer_;
};

/// The innermost scope of this thread. [async-signal-safe]
RunningCallback running_callback();

} // namespace tandem::crash
