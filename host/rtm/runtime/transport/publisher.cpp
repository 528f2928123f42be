// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/publisher.hpp"
#include "host/process/start_thread.hpp"
#include "host/rtm/runtime/transport/remote_push.hpp"

namespace RTC {

namespace {

std::string subscription_type(const coil::Properties& properties) {
    return coil::normalize(properties.getProperty("subscription_type", "flush"));
}

} // namespace

std::unique_ptr<Publisher> Publisher::create(const coil::Properties& properties,
                                             const std::string& connection, Deliver deliver) {
    const std::string type = subscription_type(properties);
    if (type != "new" && type != "periodic") return nullptr;
    return std::make_unique<Publisher>(properties, connection, type == "periodic", std::move(deliver));
}

bool Publisher::delivers_newest_only(const coil::Properties& properties) {
    const std::string type = subscription_type(properties);
    return (type == "new" || type == "periodic") && policy_of(properties) == Policy::newest;
}

// Systems made with different versions of OpenRTM-aist have the keys with or without `publisher.`.
Publisher::Policy Publisher::policy_of(const coil::Properties& properties) {
    const std::string policy = coil::normalize(
        properties.getProperty("publisher.push_policy", properties.getProperty("push_policy")));
    return policy == "fifo"   ? Policy::fifo
           : policy == "skip" ? Policy::skip
           : policy == "all"  ? Policy::all
                              : Policy::newest;
}

Publisher::Publisher(const coil::Properties& properties, std::string connection, bool periodic,
                     Deliver deliver)
    : connection_(std::move(connection)), deliver_(std::move(deliver)) {
    if (const auto* node = properties.findNode("buffer")) buffer_.init(*node);
    policy_ = policy_of(properties);
    coil::stringTo(
        skip_count_,
        properties.getProperty("publisher.skip_count", properties.getProperty("skip_count")).c_str());
    double rate = 10; // Hz, for the type periodic without a rate
    coil::stringTo(
        rate, properties.getProperty("publisher.push_rate", properties.getProperty("push_rate")).c_str());
    if (periodic && rate > 0) period_ = std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 / rate));
    thread_ = tandem::process::start_thread([this] { run(); });
}

Publisher::~Publisher() {
    {
        std::lock_guard<std::mutex> lock(mutex_);
        stopping_ = true;
    }
    wake_.notify_all();
    thread_.join();
}

DataPortStatus Publisher::write(const ByteData& bytes, bool& overwritten) {
    if (connection_lost_) return DataPortStatus::CONNECTION_LOST;
    const BufferStatus status = buffer_.writeReporting(bytes, overwritten);
    ++writes_;
    if (status == BufferStatus::FULL) return DataPortStatus::BUFFER_FULL;
    if (status == BufferStatus::TIMEOUT) return DataPortStatus::BUFFER_TIMEOUT;
    {
        std::lock_guard<std::mutex> lock(mutex_);
        written_ = true;
    }
    if (period_.count() == 0) wake_.notify_one(); // a periodic thread wakes up by itself
    return DataPortStatus::PORT_OK;
}

// The order of reading counts each message that waits or has been taken at least once: taken_ is incremented before the
// buffer is read.
std::uint64_t Publisher::lost() const {
    const std::uint64_t writes = writes_, waiting = buffer_.readable(), taken = taken_;
    return writes > waiting + taken ? writes - waiting - taken : 0;
}

// Publisher's thread. Times are absolute, so that the duration of a delivery does not delay the following periods.
void Publisher::run() {
    auto next = std::chrono::steady_clock::now() + period_;
    std::unique_lock<std::mutex> lock(mutex_);
    while (!stopping_ && !connection_lost_) {
        if (period_.count() > 0) {
            wake_.wait_until(lock, next, [this] { return stopping_; });
            next += period_;
        } else {
            wake_.wait(lock, [this] { return stopping_ || written_; });
        }
        if (stopping_) return;
        written_ = false;
        lock.unlock();
        deliver_readable();
        lock.lock();
    }
}

// Takes the messages that are readable and delivers those that the policy chooses; the others are dropped.
void Publisher::deliver_readable() {
    ByteData bytes;
    for (std::size_t readable = buffer_.readable(); readable > 0; readable = buffer_.readable()) {
        ++taken_;
        if (buffer_.read(bytes) != BufferStatus::OK) return;
        if (policy_ == Policy::newest && readable > 1) continue;
        if (policy_ == Policy::skip && skip_position_++ % (skip_count_ + 1) != skip_count_) continue;
        if (deliver_(bytes) == DataPortStatus::CONNECTION_LOST) {
            // A hanging receiver may still take this message. The next message could overtake it on another connection.
            connection_lost_ = true;
            log_lost_with_connection(connection_, 1 + buffer_.readable());
            return;
        }
        if (policy_ == Policy::fifo && period_.count() > 0) return; // one message per period
    }
}

} // namespace RTC
