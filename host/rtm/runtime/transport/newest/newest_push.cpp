// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/newest/newest_push.hpp"
#include "host/rtm/runtime/network/sending_threads.hpp"
#include <condition_variable>
#include <mutex>

namespace RTC {

/// The waiting message and the threads that call.
struct NewestPush::Calls {
    struct Message {
        std::uint64_t number;
        ByteData bytes;
    };
    std::unique_ptr<NumberedReceiver> receiver;

    std::mutex mutex; // guards what follows
    std::condition_variable wake_thread;
    std::optional<Message> waiting;
    std::uint64_t written = 0,
                  answered = 0; // numbers of the newest message, and of the newest one with an answer
    DataPortStatus answer = DataPortStatus::PORT_OK; // to that one
    unsigned threads = 0, idle = 0;
    bool stop_requested = false;

    bool has_ended() const { return stop_requested || answer == DataPortStatus::CONNECTION_LOST; }
    void call_loop();
    void keep(std::uint64_t number, std::optional<DataPortStatus> status);
};

NewestPush::NewestPush(std::unique_ptr<NumberedReceiver> receiver) : calls_(std::make_shared<Calls>()) {
    calls_->receiver = std::move(receiver);
}

NewestPush::~NewestPush() {
    const std::lock_guard<std::mutex> lock(calls_->mutex);
    calls_->stop_requested = true;
    calls_->wake_thread.notify_all();
}

DataPortStatus NewestPush::write(const ByteData& bytes) {
    Calls& calls = *calls_;
    const std::lock_guard<std::mutex> lock(calls.mutex);
    if (calls.has_ended()) return calls.answer;
    calls.waiting = Calls::Message{++calls.written, bytes};
    if (calls.idle == 0 && calls.threads < max_calls) {
        // If no further thread can be created, the message waits for the existing ones, and the next message tries
        // again.
        if (start_sending_thread([shared = calls_] { shared->call_loop(); })) ++calls.threads;
    }
    calls.wake_thread.notify_one();
    return calls.answer;
}

/// [sending thread] Makes one call after the other, each with the message that is then the newest.
void NewestPush::Calls::call_loop() {
    std::unique_lock<std::mutex> lock(mutex);
    for (;;) {
        ++idle;
        wake_thread.wait(lock, [this] { return has_ended() || waiting; });
        --idle;
        if (has_ended()) return;
        const Message message = std::move(*waiting);
        waiting.reset();
        lock.unlock();
        const auto status = receiver->put(message.number, message.bytes);
        lock.lock();
        keep(message.number, status);
    }
}

// Answers arrive in any order. The answer to an older message is ignored, unless the receiver no longer exists.
void NewestPush::Calls::keep(std::uint64_t number, std::optional<DataPortStatus> status) {
    const DataPortStatus known = status.value_or(DataPortStatus::SEND_TIMEOUT);
    if (answer == DataPortStatus::CONNECTION_LOST ||
        (number < answered && known != DataPortStatus::CONNECTION_LOST))
        return;
    answered = number;
    answer = known;
    if (has_ended()) wake_thread.notify_all();
}

} // namespace RTC
