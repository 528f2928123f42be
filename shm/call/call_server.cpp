// SPDX-License-Identifier: Apache-2.0
#include "shm/call/call_server.hpp"

#include "shm/call/call_server_state.hpp"
#include "shm/os/error.hpp"

namespace tandem::shm {

CallServer::CallServer(const CallQueueHandle& queue, const WaitOptions& how) {
    if (queue.callers == queue.mapping->side())
        throw Error(queue.mapping->path() + ": a call queue for callers of side " + name_of(queue.callers) +
                    " cannot be served here; use CallClient");
    state_ = std::make_shared<IncomingCall::State>(queue, how);
    state_->worker.open();
}

CallServer::~CallServer() { shut_down(); }

CallCounters CallServer::counters() const { return read_counters(state_->queue.view); }

/// Flattened, because everything after the worker's sleep delays the call. Constructs the call in place of the result.
std::optional<IncomingCall> CallServer::take(std::chrono::nanoseconds bound) {
    std::optional<IncomingCall> call(std::in_place, state_);
    if (state_->take(bound, call->taken_)) return call;
    call->server_.reset();
    call.reset();
    if (state_->queue.mapping->peer_state() == PeerState::dead) state_->worker.drop_submitted();
    return call;
}

void CallServer::end_all_waits() { state_->worker.end_all_waits(); }

void CallServer::shut_down() {
    state_->worker.close();
    bool polling = false;
    RecentClock clock;
    TakenCall none; // answers waiting calls and hands out none, because the queue is closed
    state_->take_runnable(polling, clock, none);
    end_all_waits();
}

} // namespace tandem::shm
