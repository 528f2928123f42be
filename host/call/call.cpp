// SPDX-License-Identifier: Apache-2.0
#include "host/call/include/TandemCall.h"
#include "host/call/thread_calls.hpp"

#include <algorithm>
#include <utility>

namespace tandem {
namespace call {
namespace {

constexpr std::chrono::milliseconds longest_duration = std::chrono::hours(24);

thread_local const SharedHandle* current_handle = nullptr;
thread_local ExecutedCall* executed_call = nullptr;

} // namespace

const SharedHandle* handle_of_thread() { return current_handle; }
const SharedHandle* exchange_handle_of_thread(const SharedHandle* handle) {
    return std::exchange(current_handle, handle);
}
void set_executed_call(ExecutedCall* call) { executed_call = call; }

} // namespace call

bool call_cancelled() { return call::executed_call && call::executed_call->cancelled(); }
void set_call_progress(double share) {
    if (call::executed_call) call::executed_call->set_progress(share);
}

CallHandle::CallHandle(std::chrono::milliseconds max_duration)
    : m_state(std::make_shared<call::HandleState>(static_cast<std::uint64_t>(
          std::chrono::nanoseconds(
              std::clamp(max_duration, std::chrono::milliseconds::zero(), call::longest_duration))
              .count()))) {}

void CallHandle::cancel() { m_state->cancelled.store(true); }
bool CallHandle::cancelled() const { return m_state->cancelled.load(); }
double CallHandle::progress() const { return m_state->progress.load(); }
bool CallHandle::pending() const { return m_state->pending.load() != 0; }

CallScope::CallScope(const CallHandle& handle)
    : m_state(handle.m_state), m_outer(call::exchange_handle_of_thread(&m_state)) {}
CallScope::~CallScope() { call::exchange_handle_of_thread(m_outer); }

} // namespace tandem
