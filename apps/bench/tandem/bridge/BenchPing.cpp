// SPDX-License-Identifier: Apache-2.0
// The OPRoS component that measures the bridge: sends pings and times the answers (ping.hpp).
#include <OPRoSInclude.h>

#include "apps/bench/tandem/bridge/messages.hpp"
#include "apps/bench/tandem/bridge/ping.hpp"

#include <memory>
#include <thread>

using namespace tandem::bench;

namespace {

/// A structure of a user, in the form of generated code.
struct Note {
    std::string text;
    std::vector<double> values;
    void save(opros::archive::oarchive& ar, const unsigned int) {
        ar << OPROS_SERIALIZATION_NVP(text) << OPROS_SERIALIZATION_NVP(values);
    }
    void load(opros::archive::iarchive& ar, const unsigned int) {
        ar >> OPROS_SERIALIZATION_NVP(text) >> OPROS_SERIALIZATION_NVP(values);
    }
};
std::string typeName(Note*) { return "Note"; }

// Write a ping into a message of each type, and read one. Return false if the message is not a ping. The time
// of sending is written last, as element `sent_at`, and `at` is read first. The filling and reading of a
// picture belong to the measured time.
void put(std::vector<double>& values, const PingMessage& ping, std::size_t sent_at) {
    values.assign(ping.begin(), ping.end());
    values[sent_at] = as_double(ticks());
}
bool get(const std::vector<double>& values, PingMessage& ping, std::uint64_t& at) {
    at = ticks();
    if (values.size() != ping.size()) return false;
    std::copy(values.begin(), values.end(), ping.begin());
    return true;
}
void put(Note& note, const PingMessage& ping, std::size_t sent_at) {
    note.text = note_text;
    put(note.values, ping, sent_at);
}
bool get(const Note& note, PingMessage& ping, std::uint64_t& at) {
    return get(note.values, ping, at) && note.text == note_text;
}
void put(std::vector<unsigned char>& image, PingMessage ping, std::size_t sent_at) {
    ping[sent_at] = as_double(ticks());
    image.resize(image_bytes);
    fill_image(image.data(), ping);
}
bool get(const std::vector<unsigned char>& image, PingMessage& ping, std::uint64_t& at) {
    if (image.size() != image_bytes) return false;
    read_image(image.data(), ping);
    at = ticks();
    return true;
}

/// The two ports, for the type of the case.
class Ports {
  public:
    virtual ~Ports() = default;
    virtual void add_to(Component& component) = 0;
    virtual void ping_for_a_slice(PingClient& client) = 0;
    virtual void send_ping(PingClient& client) = 0;
    virtual void take_answers(PingClient& client) = 0;
    virtual void take_answers_over_floor(PingClient& client) = 0;
};

template <class Message>
class PortsOf final : public Ports {
  public:
    void add_to(Component& component) override {
        component.addPort("ping", &ping_);
        component.addPort("pong", &pong_);
    }
    void ping_for_a_slice(PingClient& client) override { client.ping_for_a_slice(*this); }
    void send_ping(PingClient& client) override { client.send_ping(*this); }
    void take_answers(PingClient& client) override { client.take_answers(*this); }
    void take_answers_over_floor(PingClient& client) override { client.take_answers_over_floor(*this); }

    // The Port that ping.hpp requires.
    void send(const PingMessage& ping, std::size_t sent_at) {
        put(buffer_, ping, sent_at);
        ping_.push(buffer_);
    }
    bool receive(PingMessage& ping, std::uint64_t& at) {
        // Pops by value and reads in place, without a copy of the message.
        const std::unique_ptr<opros_any> any(pong_.pop());
        if (!any) return false;
        const auto* message = pong_.getContentPointer(*any);
        return message != nullptr && get(*message, ping, at);
    }

  private:
    OutputDataPort<Message> ping_;
    InputDataPort<Message> pong_{OPROS_FIFO, 16};
    Message buffer_; // keeps its capacity: no allocation per message
};

std::unique_ptr<Ports> ports_for(const std::string& message) {
    if (message == "note") return std::make_unique<PortsOf<Note>>();
    if (message == "image") return std::make_unique<PortsOf<std::vector<unsigned char>>>();
    return std::make_unique<PortsOf<std::vector<double>>>();
}

} // namespace

class BenchPing : public Component {
  public:
    // Polls for most of each period, so that the latency is measured and not the period.
    ReturnType onExecute() override {
        if (event_driven_)
            ports_->take_answers(*client_);
        else
            ports_->ping_for_a_slice(*client_);
        return OPROS_SUCCESS;
    }

  protected:
    // The bench sets the properties in the application profile.
    ReturnType onInitialize() override {
        Clock::calibrate();
        ports_ = ports_for(getProperty("message"));
        ports_->add_to(*this);
        event_driven_ = getProperty("event_driven") == "yes";
        client_ = std::make_unique<PingClient>(
            Samples(getProperty("file"), std::stoul(getProperty("samples")),
                    std::stod(getProperty("seconds")), std::stoul(getProperty("warm_up"))),
            getProperty("direction") == "opros-to-rtm", getProperty("cold") == "yes");
        paired_ = !getProperty("floor").empty();
        if (paired_) client_->pair(getProperty("floor"), std::stoul(getProperty("window")));
        const std::string origin = getProperty("origin_ns");
        if (!origin.empty()) client_->measure_tails(std::stol(origin));
        return OPROS_SUCCESS;
    }
    // AdaptorComp has started before, so the RTC can answer.
    ReturnType onStart() override {
        if (event_driven_ && paired_)
            floor_thread_ = std::jthread([this] { ports_->take_answers_over_floor(*client_); });
        if (event_driven_) ports_->send_ping(*client_);
        return OPROS_SUCCESS;
    }
    ReturnType onStop() override { return OPROS_SUCCESS; }
    ReturnType onDestroy() override { return OPROS_SUCCESS; }

  private:
    std::unique_ptr<Ports> ports_;
    std::unique_ptr<PingClient> client_;
    bool event_driven_ = false, paired_ = false;
    std::jthread floor_thread_;
};

extern "C" {
Component* getComponent() { return new BenchPing; }
void releaseComponent(Component* component) { delete component; }
}
