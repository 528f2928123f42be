// SPDX-License-Identifier: Apache-2.0
// Two RT-Components that measure a connection. Ping sends TimedOctetSeq of several sizes, one at a time, and
// Pong's listener sends each back. Half of the time from write() until Ping's listener has the decoded answer
// is one sample. With `read`, both components have no listeners and read their InPorts in their cycles, as
// often as they can. If Ping's OutPort is connected to its own InPort, write() and read() together are one
// sample. The source uses only OpenRTM-aist's public API, so it compiles unchanged against OpenRTM-aist 2.x.
#include <rtm/idl/BasicDataTypeSkel.h>

#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/Manager.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;
using Message = RTC::TimedOctetSeq;

const std::vector<std::uint32_t> sizes{8, 64, 1024, 16384, 262144, 1048576, 6291456};

/// Calls back with each message, in the thread that delivers it.
template <class Use>
class Listener : public RTC::ConnectorDataListenerT<Message> {
  public:
    using ReturnCode = RTC::ConnectorListenerStatus::Enum;
    explicit Listener(Use use) : use_(std::move(use)) {}
    ReturnCode operator()(RTC::ConnectorInfo&, Message& message) override {
        use_(message);
        return RTC::ConnectorListenerStatus::NO_CHANGE;
    }

  private:
    Use use_;
};
template <class Use>
void listen(RTC::InPort<Message>& port, Use use) {
    port.addConnectorDataListener(RTC::ConnectorDataListenerType::ON_RECEIVED, new Listener<Use>(use));
}

/// The first bytes of a message are its number; the last byte is the last byte of the number.
void set_number(Message& message, std::uint32_t number) {
    unsigned char* bytes = message.data.get_buffer();
    std::memcpy(bytes, &number, sizeof number);
    bytes[message.data.length() - 1] = static_cast<unsigned char>(number);
}
bool has_number(const Message& message, std::uint32_t length, std::uint32_t number) {
    if (message.data.length() != length) return false;
    const unsigned char* bytes = message.data.get_buffer();
    return std::memcmp(bytes, &number, sizeof number) == 0 &&
           bytes[length - 1] == static_cast<unsigned char>(number);
}

/// The results for one size.
struct Size {
    std::vector<double> microseconds; // one way
    std::uint32_t sent = 0, lost = 0;
    Clock::time_point begun;
};

} // namespace

class InterfaceTypesPing : public RTC::DataFlowComponentBase {
  public:
    explicit InterfaceTypesPing(RTC::Manager* manager) : RTC::DataFlowComponentBase(manager) {}

    RTC::ReturnCode_t onInitialize() override {
        bindParameter("file", file_, "interface_types.txt");
        bindParameter("messages", messages_, "1000");
        bindParameter("seconds", seconds_, "1");
        addOutPort("ping", out_);
        addInPort("pong", in_);
        reads_ = getProperties().getProperty("conf.default.read") != "no";
        alone_ = getProperties().getProperty("conf.default.read") == "alone";
        if (!reads_) listen(in_, [this](const Message& message) { take(message); });
        return RTC::RTC_OK;
    }
    /// Measures for a part of the time, so that the context stays responsive.
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        const auto end = Clock::now() + std::chrono::milliseconds(20);
        while (measured_.size() <= sizes.size() && Clock::now() < end) {
            if (measured_.empty() || is_complete(measured_.back()))
                begin_next_size();
            else
                send_one(measured_.back());
        }
        return RTC::RTC_OK;
    }

  private:
    bool is_complete(const Size& size) const {
        // The time limit applies only when there are enough samples for a median.
        return size.sent >= warm_up() + static_cast<std::uint32_t>(messages_) ||
               (size.sent >= warm_up() + 5 &&
                Clock::now() - size.begun > std::chrono::duration<double>(seconds_));
    }
    std::uint32_t warm_up() const { return std::min(static_cast<std::uint32_t>(messages_) / 10 + 2, 20U); }

    void begin_next_size() {
        if (measured_.size() == sizes.size()) {
            write_file();
            measured_.emplace_back(); // done
            return;
        }
        value_.data.length(sizes[measured_.size()]);
        std::fill_n(value_.data.get_buffer(), value_.data.length(), static_cast<unsigned char>(0x5a));
        measured_.emplace_back();
        measured_.back().begun = Clock::now();
    }
    void send_one(Size& size) {
        {
            const std::lock_guard<std::mutex> lock(mutex_);
            set_number(value_, ++number_);
            length_ = value_.data.length();
            arrived_ = false;
        }
        const auto sent = Clock::now();
        out_.write();
        if (reads_) {
            while (!in_.isNew() && Clock::now() - sent < std::chrono::seconds(1)) {
            }
            if (in_.read()) take(answer_);
        }
        std::unique_lock<std::mutex> lock(mutex_);
        const bool came = came_.wait_for(lock, std::chrono::seconds(1), [this] { return arrived_; });
        ++size.sent;
        if (!came)
            ++size.lost;
        else if (size.sent > warm_up())
            size.microseconds.push_back(std::chrono::duration<double, std::micro>(arrival_ - sent).count() /
                                        (alone_ ? 1 : 2));
    }
    /// [the thread that delivers the message]
    void take(const Message& message) {
        const auto now = Clock::now();
        const std::lock_guard<std::mutex> lock(mutex_);
        if (!has_number(message, length_, number_)) return;
        arrival_ = now;
        arrived_ = true;
        came_.notify_one();
    }
    /// Writes a line for each size: bytes, samples, lost, p50 and p99 in us. The file appears as a whole.
    void write_file() {
        {
            std::ofstream out(file_ + ".part");
            for (std::size_t i = 0; i < sizes.size(); ++i) {
                auto& samples = measured_[i].microseconds;
                std::sort(samples.begin(), samples.end());
                const auto at = [&samples](double part) {
                    return samples.empty() ? 0.0
                                           : samples[static_cast<std::size_t>(
                                                 part * static_cast<double>(samples.size() - 1))];
                };
                out << sizes[i] << ' ' << samples.size() << ' ' << measured_[i].lost << ' ' << at(0.5) << ' '
                    << at(0.99) << '\n';
            }
        }
        std::rename((file_ + ".part").c_str(), file_.c_str());
    }

    std::string file_;
    bool reads_ = false;
    bool alone_ = false; // its OutPort is connected to its own InPort
    int messages_ = 0;
    double seconds_ = 0;
    Message value_{}, answer_{};
    RTC::OutPort<Message> out_{"ping", value_};
    RTC::InPort<Message> in_{"pong", answer_};
    std::vector<Size> measured_;

    std::mutex mutex_; // guards the members below
    std::condition_variable came_;
    std::uint32_t number_ = 0, length_ = 0;
    bool arrived_ = false;
    Clock::time_point arrival_;
};

class InterfaceTypesPong : public RTC::DataFlowComponentBase {
  public:
    explicit InterfaceTypesPong(RTC::Manager* manager) : RTC::DataFlowComponentBase(manager) {}

    RTC::ReturnCode_t onInitialize() override {
        addInPort("ping", in_);
        addOutPort("pong", out_);
        reads_ = getProperties().getProperty("conf.default.read") == "yes";
        if (!reads_) listen(in_, [this](Message& message) { out_.write(message); });
        return RTC::RTC_OK;
    }
    /// The counterpart of Ping's.
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        const auto end = Clock::now() + std::chrono::milliseconds(20);
        while (reads_ && Clock::now() < end) {
            if (!in_.isNew()) continue;
            in_.read();
            out_.write(value_);
        }
        return RTC::RTC_OK;
    }

  private:
    bool reads_ = false;
    Message value_{}, answer_{};
    RTC::InPort<Message> in_{"ping", value_};
    RTC::OutPort<Message> out_{"pong", answer_};
};

extern "C" void InterfaceTypesInit(RTC::Manager* manager) {
    coil::Properties profile;
    profile.setProperty("category", "bench");
    profile.setProperty("implementation_id", "InterfaceTypesPing");
    profile.setProperty("type_name", "InterfaceTypesPing");
    // Without a default here, an argument of the creation has no effect.
    profile.setProperty("conf.default.file", "interface_types.txt");
    profile.setProperty("conf.default.messages", "1000");
    profile.setProperty("conf.default.seconds", "1");
    profile.setProperty("conf.default.read", "no");
    manager->registerFactory(profile, RTC::Create<InterfaceTypesPing>, RTC::Delete<InterfaceTypesPing>);
    coil::Properties pong;
    pong.setProperty("category", "bench");
    pong.setProperty("implementation_id", "InterfaceTypesPong");
    pong.setProperty("type_name", "InterfaceTypesPong");
    pong.setProperty("conf.default.read", "no");
    manager->registerFactory(pong, RTC::Create<InterfaceTypesPong>, RTC::Delete<InterfaceTypesPong>);
}
