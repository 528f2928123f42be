// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/call_workers.hpp"

#include "host/call/thread_calls.hpp"
#include "host/log/log.hpp"
#include "host/process/start_thread.hpp"
#include "proxy/link/protocol/call_limits.hpp"
#include "proxy/link/session/link_thread.hpp"

#include <algorithm>
#include <chrono>
#include <mutex>

namespace tandem::link {

using namespace std::chrono_literals;

namespace {

// From the refusal of a worker to the next attempt.
constexpr auto retry_pause = 1s;
// One serves a call, and one stays idle.
constexpr std::size_t kept_workers = 2;

/// The call that a worker is executing.
class WorkerCall final : public call::ExecutedCall {
  public:
    WorkerCall() { call::set_executed_call(this); }
    ~WorkerCall() override { call::set_executed_call(nullptr); }
    WorkerCall(const WorkerCall&) = delete;
    WorkerCall& operator=(const WorkerCall&) = delete;

    bool cancelled() const override {
        told_ = told_ || (call && call->cancelled());
        return told_;
    }
    void set_progress(double share) override {
        if (call) call->set_progress(share);
    }

    /// Sends the component's result. Drops the result if the component was told that the call is cancelled: the
    /// result may be incomplete, and while this host shuts down the caller still waits.
    void reply(const ReplyView& result) {
        if (told_) [[unlikely]]
            call->reply(CallStatus::shut_down);
        else
            call->reply(result.status, result.bytes);
        call = nullptr;
        told_ = false;
    }

    shm::IncomingCall* call = nullptr;

  private:
    mutable bool told_ = false;
};

} // namespace

CallWorkers::CallWorkers(const LinkOptions& options, const LinkState& state, LinkHandler& handler,
                         std::function<void()> wake_supervisor)
    : options_(options), state_(state), handler_(handler), wake_supervisor_(std::move(wake_supervisor)) {}

void CallWorkers::start() {
    const std::lock_guard lock(mutex_);
    start_worker();
}

void CallWorkers::stop() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true; // from here on the lists do not change, so they are read without the lock
    }
    threads_.clear();
    ended_.clear();
}

void CallWorkers::start_worker() {
    threads_.emplace_back(worker_stack_bytes, [this] { run(); });
    count_ = threads_.size();
    needed_ = Clock::now();
}

/// Sleeps until a call arrives, the session ends or the link closes, so that an idle link causes no wake-ups.
/// Releases the session before the call is served: a call may take long, and meanwhile the session must be able to
/// end and the next one to begin.
std::optional<shm::IncomingCall> CallWorkers::take_call() const {
    const auto session = state_.wait_for_session();
    if (!session) return std::nullopt;
    return session->incoming_calls().take(count_ > kept_workers ? options_.worker_idle_time
                                                                : shm::longest_wait);
}

/// Records that workers were needed, if few were idle. `idle`: workers that remain for further calls. Costs nothing while no
/// worker could end.
inline void CallWorkers::note_need(unsigned idle) {
    if (count_.load(std::memory_order_relaxed) > kept_workers && idle <= 1) [[unlikely]]
        needed_ = Clock::now();
}

/// Returns whether the calling worker, which does not count as idle, should end.
inline bool CallWorkers::ends_this_worker() {
    if (count_.load(std::memory_order_relaxed) <= kept_workers) [[likely]]
        return false;
    const std::lock_guard lock(mutex_);
    if (stopping_ || threads_.size() <= kept_workers || idle_ == 0 ||
        Clock::now() < needed_.load() + options_.worker_idle_time)
        return false;
    const auto own = std::find_if(threads_.begin(), threads_.end(),
                                  [](const auto& thread) { return thread.is_this_thread(); });
    ended_.splice(ended_.end(), threads_, own);
    count_ = threads_.size();
    return true;
}

void CallWorkers::start_another_worker() {
    const std::lock_guard lock(mutex_);
    const auto now = Clock::now();
    if (threads_.size() >= max_workers || stopping_ || now < retry_at_) return;
    ended_.clear(); // each returns at once
    try {
        start_worker();
    } catch (const process::NotStarted& error) {
        retry_at_ = now + retry_pause; // finding the cause takes longer than a call
        if (!has_warned_)
            log::warn("link '{}': the peer's calls wait for {} workers: {}", options_.name, threads_.size(),
                      error.what());
        has_warned_ = true;
    }
}

/// A part of run(), its only caller.
inline ReplyView CallWorkers::serve(const shm::IncomingCall& call, wire::MessageBuffer& memory) {
    // The peer may connect slightly earlier than this side. Its calls may call the peer in turn, which fails until
    // this side is up. Once the link is up, a call costs no wake-up.
    if (!state_.is_up()) {
        wake_supervisor_();
        state_.wait_until_session_is_up(1s);
    }
    try {
        if (const auto known = decode_known_request(call.arguments())) [[likely]]
            if (const auto reply = handler_.serve_known(*known, memory)) [[likely]]
                return *reply;
        const auto request = decode_request(call.arguments());
        return copy_to(memory, request
                                   ? handler_.serve(*request)
                                   : Reply::failure(CallStatus::bad_arguments, "the request is malformed"));
    } catch (const std::exception& error) { // for example out of memory: the worker must survive
        return copy_to(memory, Reply::failure(CallStatus::exception, error.what()));
    }
}

void CallWorkers::run() {
    begin_link_thread("tandem-worker");
    WorkerCall work;
    while (!state_.is_closing() && !ends_this_worker()) {
        idle_.fetch_add(1);
        auto call = take_call();
        const unsigned idle = idle_.fetch_sub(1) - 1;
        if (!call) continue;
        note_need(idle);
        // One worker must stay idle for the calls that the peer makes in turn because of this call.
        if (idle == 0) [[unlikely]]
            start_another_worker();
        work.call = &*call;
        wire::MessageBuffer memory;
        work.reply(serve(*call, memory));
    }
}

} // namespace tandem::link
