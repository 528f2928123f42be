// SPDX-License-Identifier: Apache-2.0
// CountOut sends 1, 2, 3, ... in its cycles, and CountIn sends each number back on arrival. Both write a line for each event:
// CountIn `number nanoseconds_since_it_was_sent`, CountOut `number nanoseconds_until_it_was_back` and, at its deactivation,
// `longest write nanoseconds`. With the parameters `tcp_port` of CountIn and `tcp_peer` of CountOut, each other cycle sends 16
// bytes by plain TCP and waits for them instead: `tcp number nanoseconds_until_they_were_back`.
#include "tests/integration/rtm/register_rtc.hpp"

#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/Manager.h>
#include <rtm/idl/BasicDataTypeSkel.h>

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <fstream>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

namespace {

constexpr std::size_t tcp_bytes = 16;

void send_at_once(int fd) {
    const int on = 1;
    setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

/// Returns each message to its sender, the first component that connects to the port.
void serve_tcp_echo(int port) {
    const int listener = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in any{};
    any.sin_family = AF_INET;
    any.sin_port = htons(static_cast<std::uint16_t>(port));
    if (bind(listener, reinterpret_cast<sockaddr*>(&any), sizeof any) != 0 || listen(listener, 1) != 0)
        return;
    std::thread([listener] {
        const int fd = accept(listener, nullptr, nullptr);
        send_at_once(fd);
        char bytes[tcp_bytes];
        while (recv(fd, bytes, sizeof bytes, MSG_WAITALL) == tcp_bytes &&
               send(fd, bytes, sizeof bytes, 0) > 0) {
        }
        close(fd);
    }).detach();
}

int connect_tcp(const std::string& peer) { // ADDRESS:PORT
    const int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    const std::size_t colon = peer.find(':');
    address.sin_port = htons(static_cast<std::uint16_t>(std::stoi(peer.substr(colon + 1))));
    inet_pton(AF_INET, peer.substr(0, colon).c_str(), &address.sin_addr);
    send_at_once(fd);
    return connect(fd, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0 ? fd : -1;
}

std::int64_t now() {
    timespec time{};
    clock_gettime(CLOCK_MONOTONIC, &time);
    return time.tv_sec * std::int64_t{1'000'000'000} + time.tv_nsec;
}

std::int64_t since(const RTC::Time& sent) {
    return now() - (static_cast<std::int64_t>(sent.sec) * 1'000'000'000 + sent.nsec);
}

class Lines {
  public:
    explicit Lines(const std::string& path) : file_(path, std::ios::app) {}
    void write(const std::string& line) {
        const std::lock_guard lock(mutex_);
        file_ << line << std::endl;
    }

  private:
    std::mutex mutex_;
    std::ofstream file_;
};

class Received : public RTC::ConnectorDataListenerT<RTC::TimedLong> {
  public:
    USE_CONNLISTENER_STATUS;
    explicit Received(std::function<void(RTC::TimedLong&)> use) : use_(std::move(use)) {}
    ReturnCode operator()(RTC::ConnectorInfo&, RTC::TimedLong& message) override {
        use_(message);
        return NO_CHANGE;
    }

  private:
    std::function<void(RTC::TimedLong&)> use_;
};

/// Two ports, and a file of lines, which the parameter `file` names.
class Counting : public RTC::DataFlowComponentBase {
  public:
    explicit Counting(RTC::Manager* manager)
        : RTC::DataFlowComponentBase(manager), in_("in", received_), out_("out", sent_) {}
    RTC::ReturnCode_t onInitialize() override {
        bindParameter("file", path_, "");
        addInPort("in", in_);
        addOutPort("out", out_);
        in_.addConnectorDataListener(RTC::ON_RECEIVED,
                                     new Received([this](auto& message) { take(message); }));
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onActivated(RTC::UniqueId) override {
        const std::lock_guard lock(mutex_);
        lines_ = std::make_unique<Lines>(path_);
        return RTC::RTC_OK;
    }

  protected:
    virtual void take(RTC::TimedLong& message) = 0;
    void write_down(const std::string& line) {
        const std::lock_guard lock(mutex_);
        if (lines_) lines_->write(line);
    }
    RTC::TimedLong received_, sent_;
    RTC::InPort<RTC::TimedLong> in_;
    RTC::OutPort<RTC::TimedLong> out_;

  private:
    std::string path_;
    std::mutex mutex_;
    std::unique_ptr<Lines> lines_;
};

class CountOut : public Counting {
  public:
    using Counting::Counting;
    RTC::ReturnCode_t onInitialize() override {
        bindParameter("tcp_peer", tcp_peer_, "");
        return Counting::onInitialize();
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        if (!tcp_peer_.empty() && ++cycles_ % 2 == 0) return send_by_tcp();
        const std::int64_t before = now();
        sent_.tm.sec = static_cast<CORBA::ULong>(before / 1'000'000'000);
        sent_.tm.nsec = static_cast<CORBA::ULong>(before % 1'000'000'000);
        ++sent_.data;
        out_.write();
        longest_write_ = std::max(longest_write_, now() - before);
        while (in_.isNew()) in_.read();
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onDeactivated(RTC::UniqueId) override {
        write_down("longest write " + std::to_string(longest_write_));
        return RTC::RTC_OK;
    }

  private:
    void take(RTC::TimedLong& message) override {
        write_down(std::to_string(message.data) + " " + std::to_string(since(message.tm)));
    }
    RTC::ReturnCode_t send_by_tcp() {
        if (tcp_ < 0) tcp_ = connect_tcp(tcp_peer_);
        char bytes[tcp_bytes] = {};
        const std::int64_t before = now();
        if (send(tcp_, bytes, sizeof bytes, 0) != tcp_bytes ||
            recv(tcp_, bytes, sizeof bytes, MSG_WAITALL) != tcp_bytes)
            return RTC::RTC_ERROR;
        write_down("tcp " + std::to_string(cycles_) + " " + std::to_string(now() - before));
        return RTC::RTC_OK;
    }
    std::int64_t longest_write_ = 0, cycles_ = 0;
    std::string tcp_peer_;
    int tcp_ = -1;
};

class CountIn : public Counting {
  public:
    using Counting::Counting;
    RTC::ReturnCode_t onInitialize() override {
        bindParameter("tcp_port", tcp_port_, "0");
        return Counting::onInitialize();
    }
    RTC::ReturnCode_t onActivated(RTC::UniqueId id) override {
        if (tcp_port_ > 0) serve_tcp_echo(tcp_port_);
        return Counting::onActivated(id);
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        while (in_.isNew()) in_.read();
        return RTC::RTC_OK;
    }

  private:
    void take(RTC::TimedLong& message) override {
        const std::int64_t age = since(message.tm);
        sent_ = message;
        out_.write(sent_);
        write_down(std::to_string(message.data) + " " + std::to_string(age));
    }
    int tcp_port_ = 0;
};

} // namespace

extern "C" void SequenceRtcsInit(RTC::Manager* manager) {
    register_rtc<CountOut>(manager, "CountOut");
    register_rtc<CountIn>(manager, "CountIn");
}
