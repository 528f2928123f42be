// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/remote_push.hpp"
#include <atomic>
#include <coil/stringutil.h>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

namespace RTC {

struct RemotePush::Lane {
    std::unique_ptr<RemoteReceiver> receiver; // the writer's, or the thread's while threaded is set
    Bounds bounds;
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

RemotePush::RemotePush(std::unique_ptr<RemoteReceiver> receiver, const Bounds& bounds)
    : lane_(std::make_shared<Lane>()) {
    lane_->receiver = std::move(receiver);
    lane_->bounds = bounds;
    lane_->set_bound(bounds.alone);
}

RemotePush::~RemotePush() {
    std::lock_guard<std::mutex> lock(lane_->mutex);
    lane_->ending = true;
    lane_->wake.notify_all();
}

RemotePush::Bounds RemotePush::bounds(const coil::Properties& properties) {
    Bounds bounds;
    auto milliseconds = [&](const std::string& key, double usual) {
        double seconds = usual;
        if (!coil::stringTo(seconds, properties.getProperty(key).c_str()) || !(seconds > 0)) seconds = usual;
        return std::chrono::milliseconds(std::max(1L, static_cast<long>(std::min(seconds, 3600.) * 1000)));
    };
    bounds.alone = milliseconds("put_timeout", 2);
    // What the receiving port was told comes as inport.*: this side only passes it on.
    for (const std::string buffer : {"inport.buffer.write.", "buffer.write."}) {
        if (coil::normalize(properties.getProperty(buffer + "full_policy")) != "block") continue;
        const auto held_back = milliseconds(buffer + "timeout", 1);
        bounds.alone += held_back;
        bounds.thread += held_back;
        break;
    }
    return bounds;
}

DataPortStatus RemotePush::write(const ByteData& bytes, bool alone) {
    Lane& lane = *lane_;
    if (!alone || lane.threaded.load(std::memory_order_acquire)) {
        std::unique_lock<std::mutex> lock(lane.mutex);
        lane.alone = alone;
        if (!alone && !lane.threaded) {
            lane.set_bound(lane.bounds.thread);
            lane.threaded = true;
        }
        // The thread may have caught up just now: then nothing waits, and this one sends.
        if (lane.threaded) {
            if (!lane.has_thread) {
                lane.has_thread = true;
                std::thread([shared = lane_] { shared->deliver(); }).detach();
            }
            return lane.add(lock, bytes);
        }
    }
    const auto status = lane.receiver->put(bytes);
    if (status) return *status;
    lane.set_bound(lane.bounds.thread);
    lane.hangs = true; // no thread is there that could look at it
    lane.threaded.store(true, std::memory_order_release);
    return DataPortStatus::SEND_TIMEOUT;
}

DataPortStatus RemotePush::Lane::add(std::unique_lock<std::mutex>& lock, const ByteData& message) {
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

void RemotePush::Lane::deliver() {
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
            set_bound(bounds.alone);
            threaded.store(false, std::memory_order_release);
        }
        progress.notify_all();
    }
}

} // namespace RTC
