// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/remote_push.hpp"
#include <atomic>
#include <coil/stringutil.h>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

namespace RTC {

struct RemotePush::SendQueue {
    std::unique_ptr<RemoteReceiver> receiver; // the writer's, or the thread's while threaded is set
    Limits bounds;
    std::atomic<bool> threaded{false}; // set by the writer, taken back by the thread under the mutex
    std::mutex mutex;                  // guards what follows
    std::condition_variable wake, progress;
    std::deque<ByteData> waiting; // the first one is on its way
    std::size_t bytes = 0;
    std::uint64_t taken = 0, answered = 0;
    DataPortStatus last = DataPortStatus::PORT_OK;
    bool has_thread = false, lost = false, ending = false, alone = true;
    bool hangs = false; // a wait for it was in vain: no other before it goes on

    void set_bound(std::chrono::milliseconds bound) { receiver->setTimeout(bound); }
    bool full(const ByteData& message) const {
        return waiting.size() >= 8 && bytes + message.getDataLength() > bounds.bytes;
    }
    DataPortStatus add(std::unique_lock<std::mutex>& lock, const ByteData& message);
    void deliver();
};

RemotePush::RemotePush(std::unique_ptr<RemoteReceiver> receiver, const Limits& bounds)
    : queue_(std::make_shared<SendQueue>()) {
    queue_->receiver = std::move(receiver);
    queue_->bounds = bounds;
    queue_->set_bound(bounds.sole_answer_timeout);
}

RemotePush::~RemotePush() {
    std::lock_guard<std::mutex> lock(queue_->mutex);
    queue_->ending = true;
    queue_->wake.notify_all();
}

RemotePush::Limits RemotePush::limits_from(const coil::Properties& properties) {
    Limits bounds;
    auto milliseconds = [&](const std::string& key, double usual) {
        double seconds = usual;
        if (!coil::stringTo(seconds, properties.getProperty(key).c_str()) || !(seconds > 0)) seconds = usual;
        return std::chrono::milliseconds(std::max(1L, static_cast<long>(std::min(seconds, 3600.) * 1000)));
    };
    bounds.sole_answer_timeout = milliseconds("put_timeout", 2);
    // What the receiving port was told comes as inport.*: this side only passes it on.
    for (const std::string buffer : {"inport.buffer.write.", "buffer.write."}) {
        if (coil::normalize(properties.getProperty(buffer + "full_policy")) != "block") continue;
        const auto held_back = milliseconds(buffer + "timeout", 1);
        bounds.sole_answer_timeout += held_back;
        bounds.thread += held_back;
        break;
    }
    return bounds;
}

DataPortStatus RemotePush::write(const ByteData& bytes, bool alone) {
    SendQueue& queue = *queue_;
    if (!alone || queue.threaded.load(std::memory_order_acquire)) {
        std::unique_lock<std::mutex> lock(queue.mutex);
        queue.alone = alone;
        if (!alone && !queue.threaded) {
            queue.set_bound(queue.bounds.thread);
            queue.threaded = true;
        }
        // The thread may have caught up just now: then nothing waits, and this one sends.
        if (queue.threaded) {
            if (!queue.has_thread) {
                queue.has_thread = true;
                std::thread([shared = queue_] { shared->deliver(); }).detach();
            }
            return queue.add(lock, bytes);
        }
    }
    const auto status = queue.receiver->put(bytes);
    if (status) return *status;
    queue.set_bound(queue.bounds.thread);
    queue.hangs = true; // no thread is there that could look at it
    queue.threaded.store(true, std::memory_order_release);
    return DataPortStatus::SEND_TIMEOUT;
}

DataPortStatus RemotePush::SendQueue::add(std::unique_lock<std::mutex>& lock, const ByteData& message) {
    const auto until = std::chrono::steady_clock::now() + bounds.beside;
    auto wait = [&](auto condition) { // for the receiver to go on
        if (!hangs && !progress.wait_until(lock, until, [&] { return lost || condition(); })) hangs = true;
    };
    if (full(message)) wait([&] { return !full(message); });
    if (lost) return DataPortStatus::CONNECTION_LOST;
    if (full(message)) return DataPortStatus::SEND_FULL;
    const bool idle = waiting.empty();
    waiting.push_back(message);
    bytes += message.getDataLength();
    const std::uint64_t number = ++taken;
    wake.notify_all();
    if (!idle) return DataPortStatus::PORT_OK;
    wait([&] { return answered >= number; });
    if (lost) return DataPortStatus::CONNECTION_LOST;
    return answered >= number ? last : DataPortStatus::PORT_OK;
}

void RemotePush::SendQueue::deliver() {
    std::unique_lock<std::mutex> lock(mutex);
    while (!lost) {
        wake.wait(lock, [&] { return ending || !waiting.empty(); });
        if (ending) return;
        ByteData& message = waiting.front(); // stays where it is when others are added
        lock.unlock();
        const auto status = receiver->put(message);
        lock.lock();
        bytes -= message.getDataLength();
        waiting.pop_front();
        ++answered;
        last = status.value_or(DataPortStatus::CONNECTION_LOST);
        lost = last == DataPortStatus::CONNECTION_LOST;
        hangs = false;
        if (!lost && waiting.empty() && alone) {
            set_bound(bounds.sole_answer_timeout);
            threaded.store(false, std::memory_order_release);
        }
        progress.notify_all();
    }
}

} // namespace RTC
