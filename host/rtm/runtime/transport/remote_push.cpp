// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/remote_push.hpp"
#include "host/rtm/runtime/network/sending_threads.hpp"
#include <atomic>
#include <coil/stringutil.h>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <rtm/SystemLogger.h>
#include <utility>

namespace RTC {

/// The receiver, the messages that wait for it, and the thread that sends them. The connector and that thread share the
/// ownership.
struct RemotePush::SendQueue {
    struct Message {
        ByteData bytes;
        std::chrono::steady_clock::time_point queued_at;
    };
    std::unique_ptr<RemoteReceiver> receiver; // the writer calls it, or the thread while uses_thread is set
    Limits limits;
    std::string connection;
    // Set by the writer, cleared by the thread under the mutex. The writer may read it without the mutex:
    // while it is false the thread has no message to send and touches neither it nor the receiver.
    std::atomic<bool> uses_thread{false};

    std::mutex mutex; // guards what follows
    std::condition_variable wake_thread, answer_received;
    std::deque<Message> messages; // the first one is being sent
    std::size_t queued_bytes = 0;
    std::uint64_t awaited_number = 0; // of the message whose writer waits for its answer; 0: none
    std::uint64_t queued_count = 0, answered_count = 0, delivered_count = 0; // since the beginning
    DataPortStatus last_status = DataPortStatus::PORT_OK;
    bool thread_started = false;
    bool connection_lost = false;
    bool stop_requested = false;
    bool is_sole_connector = true;
    // Set if an answer did not arrive in time. No writer waits again until the next answer.
    bool receiver_hangs = false;
    bool crosses_network = false; // the receiver is on another machine; never changes

    bool full(const ByteData& message) const {
        return messages.size() >= limits.min_queued_messages &&
               queued_bytes + message.getDataLength() > limits.max_queued_bytes;
    }
    void switch_to_thread();
    DataPortStatus add(std::unique_lock<std::mutex>& lock, const ByteData& message);
    void send_loop();
};

RemotePush::RemotePush(std::unique_ptr<RemoteReceiver> receiver, const Limits& limits, std::string connection)
    : queue_(std::make_shared<SendQueue>()) {
    queue_->connection = std::move(connection);
    queue_->receiver = std::move(receiver);
    queue_->limits = limits;
    queue_->crosses_network = queue_->receiver->is_on_another_machine();
    queue_->receiver->set_timeout(limits.sole_answer_timeout);
    if (!queue_->crosses_network) return;
    queue_->limits.shared_answer_timeout = std::chrono::milliseconds(0);
}

RemotePush::~RemotePush() {
    std::lock_guard<std::mutex> lock(queue_->mutex);
    queue_->stop_requested = true;
    queue_->wake_thread.notify_all();
}

RemotePush::Limits RemotePush::limits_from(const coil::Properties& properties) {
    // The default applies unless the value is a positive number of seconds. One hour is the maximum.
    auto milliseconds = [&](const std::string& key, double default_seconds) {
        double seconds = default_seconds;
        if (!coil::stringTo(seconds, properties.getProperty(key).c_str()) || !(seconds > 0))
            seconds = default_seconds;
        return std::chrono::milliseconds(std::max(1L, static_cast<long>(std::min(seconds, 3600.) * 1000)));
    };
    Limits limits;
    limits.sole_answer_timeout = milliseconds("put_timeout", 2);
    // The receiving port's buffer settings are in the profile as inport.*. They are read first, because it is that
    // buffer that holds the message back.
    for (const std::string buffer : {"inport.buffer.write.", "buffer.write."}) {
        if (coil::normalize(properties.getProperty(buffer + "full_policy")) != "block") continue;
        const auto full_buffer_wait = milliseconds(buffer + "timeout", 1);
        limits.sole_answer_timeout += full_buffer_wait;
        limits.thread_answer_timeout += full_buffer_wait;
        break;
    }
    return limits;
}

DataPortStatus RemotePush::write(const ByteData& bytes, bool is_sole_connector) {
    SendQueue& queue = *queue_;
    is_sole_connector = is_sole_connector && !queue.crosses_network;
    if (!is_sole_connector || queue.uses_thread.load(std::memory_order_acquire)) {
        std::unique_lock<std::mutex> lock(queue.mutex);
        queue.is_sole_connector = is_sole_connector;
        if (!is_sole_connector) queue.switch_to_thread();
        // If the thread has caught up since the check above, the queue is empty and this call sends.
        if (queue.uses_thread) {
            // The thread uses the receiver only while there are messages.
            if (queue.messages.empty() && !queue.connection_lost && queue.receiver->try_put(bytes))
                return DataPortStatus::PORT_OK;
            if (!queue.thread_started)
                queue.thread_started = start_sending_thread([shared = queue_] { shared->send_loop(); });
            if (!queue.thread_started) return DataPortStatus::PORT_ERROR; // the next message tries again
            return queue.add(lock, bytes);
        }
    }
    if (const auto status = queue.receiver->put(bytes)) return *status;
    // No thread uses the receiver yet, so it may be changed without the mutex. The thread sends from the next message
    // on.
    queue.receiver_hangs = true;
    queue.switch_to_thread();
    return DataPortStatus::SEND_TIMEOUT;
}

std::uint64_t RemotePush::undelivered() const {
    const std::lock_guard lock(queue_->mutex);
    return queue_->queued_count - queue_->delivered_count;
}

void RemotePush::SendQueue::switch_to_thread() {
    if (uses_thread) return;
    receiver->set_timeout(limits.thread_answer_timeout);
    uses_thread.store(true, std::memory_order_release);
}

/// Queues one message and waits for its answer, unless other messages wait before it. The caller holds the mutex.
DataPortStatus RemotePush::SendQueue::add(std::unique_lock<std::mutex>& lock, const ByteData& message) {
    // Both waits share one deadline, which is the longest delay for the writer.
    const auto deadline = std::chrono::steady_clock::now() + limits.shared_answer_timeout;
    auto wait_until = [&](auto condition) {
        if (receiver_hangs) return;
        receiver_hangs =
            !answer_received.wait_until(lock, deadline, [&] { return connection_lost || condition(); });
    };
    if (full(message)) wait_until([&] { return !full(message); });
    if (connection_lost) return DataPortStatus::CONNECTION_LOST;
    if (full(message)) return DataPortStatus::SEND_FULL;

    const bool was_empty = messages.empty();
    messages.push_back({message, std::chrono::steady_clock::now()});
    queued_bytes += message.getDataLength();
    const std::uint64_t number = ++queued_count;
    wake_thread.notify_all();
    if (!was_empty) return DataPortStatus::PORT_OK;
    awaited_number = number;
    wait_until([&] { return answered_count >= number; });
    awaited_number = 0;
    if (connection_lost) return DataPortStatus::CONNECTION_LOST;
    return answered_count >= number ? last_status : DataPortStatus::PORT_OK;
}

/// [sending thread] Sends the messages one after the other until the connector or the receiver is gone.
void RemotePush::SendQueue::send_loop() {
    std::unique_lock<std::mutex> lock(mutex);
    while (!connection_lost) {
        wake_thread.wait(lock, [&] { return stop_requested || !messages.empty(); });
        if (stop_requested) return;
        Message& message = messages.front(); // push_back() does not move it: a deque keeps references valid
        const bool too_old = crosses_network && std::chrono::steady_clock::now() - message.queued_at >
                                                    limits.sole_answer_timeout;
        lock.unlock();
        const auto status = too_old ? std::nullopt : receiver->put(message.bytes);
        lock.lock();
        queued_bytes -= message.bytes.getDataLength();
        messages.pop_front();
        ++answered_count;
        last_status =
            status.value_or(crosses_network ? DataPortStatus::SEND_TIMEOUT : DataPortStatus::CONNECTION_LOST);
        connection_lost = last_status == DataPortStatus::CONNECTION_LOST;
        if (last_status == DataPortStatus::PORT_OK) ++delivered_count;
        receiver_hangs = false;
        // The thread has caught up: the writer may send directly again, unless the port has other connectors to serve.
        if (!connection_lost && messages.empty() && is_sole_connector) {
            receiver->set_timeout(limits.sole_answer_timeout);
            uses_thread.store(false, std::memory_order_release);
        }
        answer_received.notify_all();
    }
    // A writer that waits learns from write() that its message is lost. No writer adds another one.
    const std::uint64_t lost = messages.size() + (awaited_number == answered_count ? 0 : 1);
    lock.unlock();
    log_lost_with_connection(connection, lost);
}

void log_lost_with_connection(const std::string& connection, std::uint64_t messages) {
    const Logger rtclog("connections");
    if (messages != 0)
        RTC_ERROR((
            "connection %s: %llu messages that write() had accepted are lost with it, because the "
            "receiver has ended or has not answered in time; one that hangs may still take the first of them",
            connection.c_str(), static_cast<unsigned long long>(messages)));
}

} // namespace RTC
