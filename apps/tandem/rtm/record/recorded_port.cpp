// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/rtm/record/recorded_port.hpp"

#include "shm/os/clock.hpp"

#include <rtm/NVUtil.h>

#include <atomic>
#include <charconv>
#include <system_error>

namespace tandem::command {

bool ReceivedSamples::add(std::size_t port, std::uint64_t time_ns, const RTC::ByteData& bytes) {
    const std::lock_guard lock(mutex_);
    if (bytes_ + bytes.getDataLength() > max_bytes) return false;
    bytes_ += bytes.getDataLength();
    samples_.push_back({port, time_ns, bytes});
    received_.notify_one();
    return true;
}

std::vector<ReceivedSample> ReceivedSamples::take(std::chrono::milliseconds timeout) {
    std::unique_lock lock(mutex_);
    received_.wait_for(lock, timeout, [this] { return !samples_.empty(); });
    bytes_ = 0;
    return std::exchange(samples_, {});
}

/// Keeps each message that the port receives.
class RecordedPort::Listener : public RTC::ConnectorDataListener {
  public:
    Listener(std::size_t number, ReceivedSamples& samples) : number_(number), samples_(samples) {}
    ReturnCode operator()(RTC::ConnectorInfo&, RTC::ByteData& bytes, const std::string&) override {
        ++received;
        if (!samples_.add(number_, shm::now_ns(), bytes)) ++dropped;
        return NO_CHANGE;
    }
    std::atomic<std::uint64_t> received{0}, dropped{0};

  private:
    const std::size_t number_;
    ReceivedSamples& samples_;
};

class RecordedPort::Port : public RTC::InPortBase {
  public:
    Port(const std::string& type, Listener* of) : RTC::InPortBase("record", type.c_str()), listener(of) {
        addProperty("dataport.marshaling_types", "cdr");
        addConnectorDataListener(RTC::ConnectorDataListenerType::ON_RECEIVED, listener);
    }
    bool read(std::string) override { return false; }
    Listener* const listener; ///< owned by the port's list of listeners
};

RecordedPort::RecordedPort(RemotePort remote, const wire::Type& message, std::size_t number,
                           ReceivedSamples& samples, const std::vector<std::string>& properties)
    : remote_(std::move(remote)), message_(message), properties_(properties),
      port_(
          std::make_unique<Port>(require_data_type(remote_, "DataOutPort"), new Listener(number, samples))) {
    connect();
}

RecordedPort::~RecordedPort() = default;

void RecordedPort::connect() {
    connection_ = std::make_unique<PortConnection>(remote_, *port_, properties_, "tandem-record");
}

std::uint64_t RecordedPort::dropped() const { return port_->listener->dropped; }
std::uint64_t RecordedPort::received() const { return port_->listener->received; }

std::optional<std::uint64_t> RecordedPort::lost_by_sender() {
    try {
        RTC::ConnectorProfile_var profile = remote_.object->get_connector_profile(connection_->id().c_str());
        const std::string lost = NVUtil::toString(profile->properties, "dataport.lost");
        std::uint64_t count = 0;
        const auto [end, error] = std::from_chars(lost.data(), lost.data() + lost.size(), count);
        if (error != std::errc() || end != lost.data() + lost.size()) return std::nullopt;
        lost_ = lost_before_ + count;
        return lost_;
    } catch (const CORBA::SystemException&) { // its host is gone
        return std::nullopt;
    }
}

bool RecordedPort::restore() {
    if (connection_->exists_at_remote_port()) return false;
    connect();
    lost_before_ = lost_; // the sender counts for each connection
    return true;
}

} // namespace tandem::command
