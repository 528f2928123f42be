// SPDX-License-Identifier: Apache-2.0
#include "remote_push.hpp"
#include <atomic>
#include <coil/stringutil.h>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

namespace RTC {

struct RemotePush::Lane {
    std::unique_ptr<RemoteReceiver> receiver; // the writer's, or the thread's while slow is set
    Bounds bounds;
    std::atomic<bool> slow{false}; // set by the writer, taken back by the thread under the mutex
    std::mutex mutex;              // guards what follows
    std::condition_variable wake;
    std::deque<ByteData> waiting;
    std::size_t bytes = 0;
    bool has_thread = false, lost = false, ending = false;

    void set_bound(std::chrono::milliseconds bound) {
        receiver->setTimeout(static_cast<unsigned long>(bound.count()));
    }
    DataPortStatus add(const ByteData& message) {
        if (lost) return DataPortStatus::CONNECTION_LOST;
        if (waiting.size() >= 8 && bytes + message.getDataLength() > bounds.bytes)
            return DataPortStatus::SEND_FULL;
        waiting.push_back(message);
        bytes += message.getDataLength();
        wake.notify_all();
        return DataPortStatus::PORT_OK;
    }
};

RemotePush::RemotePush(std::unique_ptr<RemoteReceiver> receiver, const Bounds& bounds)
    : lane_(std::make_shared<Lane>()) {
    lane_->receiver = std::move(receiver);
    lane_->bounds = bounds;
    lane_->set_bound(bounds.writer);
}

RemotePush::~RemotePush() {
    std::lock_guard<std::mutex> lock(lane_->mutex);
    lane_->ending = true;
    lane_->wake.notify_all();
}

RemotePush::Bounds RemotePush::bounds(const coil::Properties& connector_properties) {
    Bounds bounds;
    double seconds = 0;
    if (coil::stringTo(seconds, connector_properties.getProperty("put_timeout").c_str()) && seconds >= 0.001)
        bounds.writer = std::chrono::milliseconds(static_cast<long>(seconds * 1000));
    return bounds;
}

DataPortStatus RemotePush::write(const ByteData& bytes) {
    if (lane_->slow.load(std::memory_order_acquire)) {
        std::lock_guard<std::mutex> lock(lane_->mutex);
        // It may have caught up just now: then nothing waits, and this thread sends.
        if (lane_->slow.load(std::memory_order_relaxed)) {
            const DataPortStatus status = lane_->add(bytes);
            if (status == DataPortStatus::PORT_OK && !lane_->has_thread) {
                lane_->has_thread = true;
                std::thread([lane = lane_] { run(lane); }).detach();
            }
            return status;
        }
    }
    const DataPortStatus status = lane_->receiver->put(bytes);
    if (status != DataPortStatus::SEND_TIMEOUT) return status;
    lane_->set_bound(lane_->bounds.thread);
    lane_->slow.store(true, std::memory_order_release);
    return status;
}

void RemotePush::run(const std::shared_ptr<Lane>& lane) {
    std::unique_lock<std::mutex> lock(lane->mutex);
    for (;;) {
        lane->wake.wait(lock, [&] { return lane->ending || !lane->waiting.empty(); });
        if (lane->ending) return;
        const ByteData message = lane->waiting.front();
        lock.unlock();
        const DataPortStatus status = lane->receiver->put(message);
        lock.lock();
        lane->waiting.pop_front();
        lane->bytes -= message.getDataLength();
        if (status == DataPortStatus::SEND_TIMEOUT || status == DataPortStatus::CONNECTION_LOST) {
            lane->lost = true;
            return;
        }
        if (!lane->waiting.empty()) continue;
        lane->set_bound(lane->bounds.writer);
        lane->slow.store(false, std::memory_order_release);
    }
}

} // namespace RTC
