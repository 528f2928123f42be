// SPDX-License-Identifier: Apache-2.0
#include "host/crash/callback_scope.hpp"

#include "host/crash/alternate_stack.hpp"

namespace tandem::crash {
namespace {

thread_local RunningCallback running;

} // namespace

CallbackScope::CallbackScope(const char* component, const char* callback, const void* code)
    : outer_(running) {
    give_this_thread_an_alternate_stack();
    running = {component, callback, code};
}

CallbackScope::~CallbackScope() { running = outer_; }

RunningCallback running_callback() { return running; }

} // namespace tandem::crash
