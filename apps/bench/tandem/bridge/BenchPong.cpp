// SPDX-License-Identifier: Apache-2.0
// The RT-Component that measures the bridge: answers each ping at once (ping.hpp).
#include "BenchBridgeSkel.h"

#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/Manager.h>
#include <rtm/idl/BasicDataTypeSkel.h>

#include "apps/bench/tandem/bridge/messages.hpp"
#include "apps/bench/tandem/bridge/ping.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <thread>
#include <vector>

using namespace tandem::bench;

namespace {

// Write a ping into a message of each type, and read one. Return false if the message is not a ping. The time
// of sending is written last, as element `sent_at`, and `at` is read first. The filling and reading of a
// picture belong to the measured time.
template <class Sequence>
void put_values(Sequence& values, const PingMessage& ping, std::size_t sent_at) {
    values.length(ping.size());
    std::copy(ping.begin(), ping.end(), values.get_buffer());
    values.get_buffer()[sent_at] = as_double(ticks());
}
template <class Sequence>
bool get_values(const Sequence& values, PingMessage& ping, std::uint64_t& at) {
    at = ticks();
    if (values.length() != ping.size()) return false;
    std::copy_n(values.get_buffer(), ping.size(), ping.begin());
    return true;
}
void put(RTC::TimedDoubleSeq& message, const PingMessage& ping, std::size_t sent_at) {
    put_values(message.data, ping, sent_at);
}
bool get(const RTC::TimedDoubleSeq& message, PingMessage& ping, std::uint64_t& at) {
    return get_values(message.data, ping, at);
}
void put(Bench::Note& note, const PingMessage& ping, std::size_t sent_at) {
    note.text = note_text;
    put_values(note.values, ping, sent_at);
}
bool get(const Bench::Note& note, PingMessage& ping, std::uint64_t& at) {
    return get_values(note.values, ping, at) && std::string_view(note.text.in()) == note_text;
}
void put(RTC::TimedOctetSeq& image, PingMessage ping, std::size_t sent_at) {
    ping[sent_at] = as_double(ticks());
    image.data.length(image_bytes);
    fill_image(image.data.get_buffer(), ping);
}
bool get(const RTC::TimedOctetSeq& image, PingMessage& ping, std::uint64_t& at) {
    if (image.data.length() != image_bytes) return false;
    read_image(image.data.get_buffer(), ping);
    at = ticks();
    return true;
}

/// Calls back with each message.
template <class Message, class Use>
class ArrivalListener final : public RTC::ConnectorDataListenerT<Message> {
  public:
    using ReturnCode = RTC::ConnectorListenerStatus::Enum;
    explicit ArrivalListener(Use use) : use_(std::move(use)) {}
    ReturnCode operator()(RTC::ConnectorInfo&, Message& message) override {
        use_(message);
        return RTC::ConnectorListenerStatus::NO_CHANGE;
    }

  private:
    Use use_;
};

/// The two ports, for the type of the case.
class Ports {
  public:
    virtual ~Ports() = default;
    virtual void add_to(RTC::RTObject_impl& rtc) = 0;
    virtual void answer_when_woken(PingServer& server) = 0;
    virtual void answer_for_a_slice(PingServer& server) = 0;
};

template <class Message>
class PortsOf final : public Ports {
  public:
    void add_to(RTC::RTObject_impl& rtc) override {
        rtc.addInPort("ping", in_);
        rtc.addOutPort("pong", out_);
    }
    /// A listener answers, in the thread that the message wakes.
    void answer_when_woken(PingServer& server) override {
        const auto answer = [this, &server](const Message& message) {
            PingMessage ping;
            std::uint64_t at = 0;
            if (get(message, ping, at)) server.answer(*this, ping, at);
        };
        in_.addConnectorDataListener(RTC::ON_RECEIVED,
                                     new ArrivalListener<Message, decltype(answer)>(answer));
    }
    void answer_for_a_slice(PingServer& server) override { server.answer_for_a_slice(*this); }

    // The Port that ping.hpp requires.
    void send(const PingMessage& ping, std::size_t sent_at) {
        put(pong_, ping, sent_at);
        out_.write();
    }
    bool receive(PingMessage& ping, std::uint64_t& at) {
        // RTCs usually make these two calls.
        if (!in_.isNew()) return false;
        in_.read();
        return get(ping_, ping, at);
    }

  private:
    Message ping_{}, pong_{};
    RTC::InPort<Message> in_{"ping", ping_};
    RTC::OutPort<Message> out_{"pong", pong_};
};

std::unique_ptr<Ports> ports_for(const std::string& message) {
    if (message == "note") return std::make_unique<PortsOf<Bench::Note>>();
    if (message == "image") return std::make_unique<PortsOf<RTC::TimedOctetSeq>>();
    return std::make_unique<PortsOf<RTC::TimedDoubleSeq>>();
}

} // namespace

class BenchPong : public RTC::DataFlowComponentBase {
  public:
    explicit BenchPong(RTC::Manager* manager) : RTC::DataFlowComponentBase(manager) {}

    RTC::ReturnCode_t onInitialize() override {
        // The tick counter is the same in all processes, but its rate is measured in each.
        Clock::calibrate();
        ports_ = ports_for(getProperties().getProperty("message"));
        event_driven_ = getProperties().getProperty("event_driven") == "yes";
        const std::string floor = getProperties().getProperty("floor");
        if (!floor.empty()) server_.pair(floor);
        const std::string origin = getProperties().getProperty("origin_ns");
        if (!origin.empty()) server_.tell_lateness(std::stol(origin));
        if (event_driven_ && !floor.empty())
            floor_thread_ = std::jthread([this] { server_.answer_over_floor(); });
        if (event_driven_) ports_->answer_when_woken(server_);
        ports_->add_to(*this);
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        if (!event_driven_) ports_->answer_for_a_slice(server_);
        return RTC::RTC_OK;
    }

  private:
    PingServer server_;
    std::unique_ptr<Ports> ports_;
    bool event_driven_ = false;
    std::jthread floor_thread_;
};

/// Sixteen unused ports.
class BenchIdle : public RTC::DataFlowComponentBase {
  public:
    explicit BenchIdle(RTC::Manager* manager) : RTC::DataFlowComponentBase(manager) {}

    RTC::ReturnCode_t onInitialize() override {
        for (int i = 0; i < 16; ++i) {
            ports_.push_back(std::make_unique<RTC::InPort<RTC::TimedDoubleSeq>>(
                ("in" + std::to_string(i)).c_str(), value_));
            addInPort(ports_.back()->name(), *ports_.back());
        }
        return RTC::RTC_OK;
    }

  private:
    RTC::TimedDoubleSeq value_;
    std::vector<std::unique_ptr<RTC::InPort<RTC::TimedDoubleSeq>>> ports_;
};

extern "C" void BenchPongInit(RTC::Manager* manager) {
    // Manager::load() calls this function, whose name is the name of the library followed by "Init".
    coil::Properties profile;
    profile.setProperty("implementation_id", "BenchPong");
    profile.setProperty("type_name", "BenchPong");
    profile.setProperty("category", "bench");
    manager->registerFactory(profile, RTC::Create<BenchPong>, RTC::Delete<BenchPong>);
    profile.setProperty("implementation_id", "BenchIdle");
    profile.setProperty("type_name", "BenchIdle");
    manager->registerFactory(profile, RTC::Create<BenchIdle>, RTC::Delete<BenchIdle>);
}
