// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/push_receiver.hpp"
#include "host/rtm/runtime/transport/ring/message_ring.hpp"
#include "host/rtm/runtime/transport/ring/message_server.hpp"
#include <rtm/InPortBase.h>
#include <utility>

namespace RTC {

PushReceiver::PushReceiver(InPortBase& port, const ConnectorInfo& info, CdrBufferBase& buffer,
                           std::shared_ptr<DirectBufferBase> direct_buffer)
    : port_(port), listeners_(*port.getListeners()), info_(info), buffer_(buffer),
      direct_buffer_(std::move(direct_buffer)),
      in_place_(direct_buffer_ ? nullptr : dynamic_cast<InPlaceBuffer*>(&buffer)),
      marshaling_type_(info.properties.getProperty("marshaling_type", "cdr")),
      stamps_(timestampPolicy(info.properties) == TimestampPolicy::on_received) {}

PushReceiver::~PushReceiver() = default;

DataPortStatus PushReceiver::receive(ByteData& bytes) {
    const tandem::rt::ShortLock lock(open_mutex_);
    return receive_locked(bytes);
}

DataPortStatus PushReceiver::receive_numbered(std::uint64_t number, ByteData& bytes) {
    const std::lock_guard lock(open_mutex_);
    if (open_ && number <= newest_number_) return DataPortStatus::PORT_OK;
    newest_number_ = number;
    return receive_locked(bytes);
}

DataPortStatus PushReceiver::receive_locked(ByteData& bytes) {
    if (!open_) return DataPortStatus::CONNECTION_LOST;
    if (stamps_) port_.stampOnReceive(bytes);
    const auto notify = [&](ConnectorDataListenerType event) {
        listeners_.notify(event, info_, bytes, marshaling_type_);
    };
    notify(ConnectorDataListenerType::ON_RECEIVED);
    bool overwritten = false;
    const auto write = [&] {
        if (direct_buffer_) return direct_buffer_->writeBytes(bytes, overwritten);
        const bool is_told = listeners_.has(ConnectorDataListenerType::ON_BUFFER_OVERWRITE);
        return is_told ? buffer_.writeReporting(bytes, overwritten) : buffer_.write(bytes);
    };
    return store(write, overwritten, notify);
}

bool PushReceiver::receive_direct(const DirectValue& message, DataPortStatus& status) {
    const tandem::rt::ShortLock lock(open_mutex_);
    if (!open_ || direct_buffer_ == nullptr || stamps_ || direct_buffer_->type() != message.type)
        return false;
    if (!listeners_.hasDataListener()) {
        status = port_status(direct_buffer_->writeValue(message.value));
        return true;
    }
    if (!listeners_.allTakeValues(message.type)) return false;
    status = receive_value(message);
    return true;
}

// Listeners may change the message, but not what the sender has.
DataPortStatus PushReceiver::receive_value(const DirectValue& message) {
    direct_buffer_->copy(message.value, value_);
    const auto notify = [&](ConnectorDataListenerType event) {
        listeners_.notifyValue(event, info_, value_.get());
    };
    notify(ConnectorDataListenerType::ON_RECEIVED);
    const bool is_needed_then = listeners_.has(ConnectorDataListenerType::ON_BUFFER_WRITE) ||
                                listeners_.has(ConnectorDataListenerType::ON_BUFFER_OVERWRITE);
    bool overwritten = false;
    const auto write = [&] {
        return is_needed_then ? direct_buffer_->writeValue(value_.get(), overwritten)
                              : direct_buffer_->takeValue(value_.get(), overwritten);
    };
    return store(write, overwritten, notify);
}

// Buffer and receiver events come in pairs: OpenRTM-aist calls listeners of both kinds on the receiving side.
template <class Write, class Notify>
DataPortStatus PushReceiver::store(const Write& write, const bool& overwritten, const Notify& notify) {
    using Type = ConnectorDataListenerType;
    const DataPortStatus status = port_status(write());
    switch (status) {
    case DataPortStatus::PORT_OK:
        if (overwritten) notify(Type::ON_BUFFER_OVERWRITE);
        notify(Type::ON_BUFFER_WRITE);
        break;
    case DataPortStatus::BUFFER_FULL:
        notify(Type::ON_BUFFER_FULL);
        notify(Type::ON_RECEIVER_FULL);
        break;
    case DataPortStatus::BUFFER_TIMEOUT:
        notify(Type::ON_BUFFER_WRITE_TIMEOUT);
        notify(Type::ON_RECEIVER_TIMEOUT);
        break;
    default:
        notify(Type::ON_RECEIVER_ERROR);
    }
    return status;
}

class PushReceiver::RingTurn {
  public:
    enum class Wait : bool { no, yes };
    /// Does not wait for the calling thread itself, which has the turn while it calls a listener.
    RingTurn(std::atomic<std::thread::id>& owner, Wait wait) : owner_(owner) {
        const auto self = std::this_thread::get_id();
        for (auto now = std::thread::id();
             !(is_mine_ = owner_.compare_exchange_strong(now, self, std::memory_order_acquire)) &&
             wait == Wait::yes && now != self;
             now = std::thread::id())
            owner_.wait(now, std::memory_order_relaxed);
    }
    ~RingTurn() {
        if (!is_mine_) return;
        owner_.store(std::thread::id(), std::memory_order_release);
        owner_.notify_one();
    }
    RingTurn(const RingTurn&) = delete;
    RingTurn& operator=(const RingTurn&) = delete;
    bool is_mine() const { return is_mine_; }

  private:
    std::atomic<std::thread::id>& owner_;
    bool is_mine_ = false;
};

void PushReceiver::close() {
    {
        const RingTurn turn(ring_owner_, RingTurn::Wait::yes);
        // A sender may have disconnected after its last message.
        if (!listeners_.hasDataListener()) receive_with_turn();
        ring_.reset();
        const std::lock_guard lock(open_mutex_);
        open_ = false;
    }
    server_.reset(); // its thread may wait for the turn
}

bool PushReceiver::open_ring(std::unique_ptr<MessageRingReader> ring, bool little_endian) {
    const RingTurn turn(ring_owner_, RingTurn::Wait::yes);
    {
        const std::lock_guard lock(open_mutex_);
        if (!open_) return false;
    }
    ring_message_.isLittleEndian(little_endian);
    ring_ = std::move(ring);
    receive_with_turn();
    return true;
}

DataPortStatus PushReceiver::receive_by_call(ByteData& bytes) {
    const RingTurn turn(ring_owner_, RingTurn::Wait::yes);
    receive_with_turn();
    const DataPortStatus status = receive(bytes);
    receive_with_turn(); // a listener may have added another one
    if (ring_ != nullptr && listeners_.hasDataListener()) start_server();
    return status;
}

// The ring's turn is this thread's.
void PushReceiver::start_server() {
    if (std::exchange(has_tried_to_serve_, true)) return;
    const auto receive = [receiver = shared_from_this()] {
        const RingTurn turn(receiver->ring_owner_, RingTurn::Wait::yes);
        const auto last = receiver->receive_with_turn();
        return receiver->ring_ != nullptr ? last : DataPortStatus(DataPortStatus::PORT_ERROR);
    };
    try {
        server_ = std::make_unique<MessageServer>(*ring_, find_servant_owner(&port_), receive);
    } catch (const std::runtime_error& error) { // from shared memory, or no further thread is possible
        const Logger rtclog("connections");
        RTC_DEBUG(("messages come by calls of the ORB, not through shared memory: %s", error.what()));
    }
}

void PushReceiver::receive_from_ring() {
    const RingTurn turn(ring_owner_, RingTurn::Wait::yes);
    if (turn.is_mine()) receive_with_turn(); // otherwise a listener is calling, and its caller checks again
}

void PushReceiver::try_receive_from_ring() {
    const RingTurn turn(ring_owner_, RingTurn::Wait::no);
    if (!turn.is_mine() || ring_ == nullptr) return;
    if (listeners_.hasDataListener())
        ring_->accept_messages(false);
    else
        receive_with_turn();
}

// Receives at most as many messages as a ring holds, so that a faster sender does not keep this thread busy.
std::optional<DataPortStatus> PushReceiver::receive_with_turn() {
    std::optional<DataPortStatus> last;
    if (ring_ == nullptr) return last;
    for (std::size_t i = 0; i < MessageRingReader::max_messages; ++i) {
        // Before each check, because a listener may add another listener.
        ring_->accept_messages(!listeners_.hasDataListener());
        const auto message = ring_->read();
        if (!message) break;
        ring_message_.writeData(reinterpret_cast<const unsigned char*>(message->data()), message->size());
        last = receive(ring_message_);
    }
    if (!ring_->is_corrupt()) [[likely]]
        return last;
    Logger rtclog("connections");
    RTC_ERROR((
        "connection %s: the sender has damaged the ring of shared memory; from now on messages come by calls",
        info_.name.c_str()));
    ring_.reset();
    return last;
}

} // namespace RTC
