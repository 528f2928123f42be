// SPDX-License-Identifier: Apache-2.0
// CountOut sends 1, 2, 3, ... in its cycles, CountIn sends each number back when it comes. Both write down what happens, a
// line each: CountIn `number nanoseconds_since_it_was_sent`, CountOut `number nanoseconds_until_it_was_back` and, at its
// deactivation, `longest write nanoseconds`.
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

namespace {

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
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
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
    std::int64_t longest_write_ = 0;
};

class CountIn : public Counting {
  public:
    using Counting::Counting;
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
};

} // namespace

extern "C" void SequenceRtcsInit(RTC::Manager* manager) {
    register_rtc<CountOut>(manager, "CountOut");
    register_rtc<CountIn>(manager, "CountIn");
}
