// SPDX-License-Identifier: Apache-2.0
// The RT-Component whose instructions are counted: it performs one operation per cycle, between two marks.
#include "BenchEchoSkel.h"

#include <rtm/CorbaPort.h>
#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/Manager.h>
#include <rtm/idl/BasicDataTypeSkel.h>

#include "apps/bench/path/path_mark.hpp"

#include <algorithm>
#include <array>

using tandem::bench::mark;
using tandem::bench::PathMark;

namespace {

/// The servant behind the provided service port. [worker of the proxy, or the caller's thread]
class Echo : public POA_Bench::Echo, public PortableServer::RefCountServantBase {
  public:
    CORBA::Double twice(CORBA::Double value) override {
        mark(PathMark::served);
        return 2 * value;
    }
};

} // namespace

/// Its property `role` selects what it does: send, receive, call, or only answer calls.
class BenchPath : public RTC::DataFlowComponentBase {
  public:
    explicit BenchPath(RTC::Manager* manager) : RTC::DataFlowComponentBase(manager) {}

    RTC::ReturnCode_t onInitialize() override {
        addOutPort("out", out_);
        addInPort("in", in_);
        provided_.registerProvider("echo", "Bench::Echo", servant_);
        required_.registerConsumer("echo", "Bench::Echo", echo_);
        addPort(provided_);
        addPort(required_);
        sent_.data.length(received_.size());
        role_ = getProperties().getProperty("role");
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        if (role_ == "send") send();
        if (role_ == "receive") receive();
        if (role_ == "call") call();
        return RTC::RTC_OK;
    }

  private:
    void send() {
        sent_.data[0] += 1;
        mark(PathMark::send_begin);
        out_.write();
        mark(PathMark::send_end);
    }
    void receive() {
        mark(PathMark::receive_begin);
        const bool received = read_values();
        mark(received ? PathMark::receive_end : PathMark::nothing);
    }
    /// Makes two calls, as RTCs are written. Returns false if there is no newer message.
    bool read_values() {
        if (!in_.isNew()) return false;
        in_.read();
        if (read_.data.length() != received_.size() || read_.data[0] <= received_[0]) return false;
        std::copy_n(read_.data.get_buffer(), received_.size(), received_.begin());
        return true;
    }
    /// A call fails with an exception until the peer is connected.
    void call() {
        argument_ += 1;
        PathMark end = PathMark::call_end;
        mark(PathMark::call_begin);
        try {
            if (echo_->twice(argument_) != 2 * argument_) end = PathMark::nothing;
        } catch (const CORBA::Exception&) {
            end = PathMark::nothing;
        }
        mark(end);
    }

    std::string role_;
    std::array<double, 6> received_{};
    double argument_ = 0;
    RTC::TimedDoubleSeq sent_{}, read_{};
    RTC::OutPort<RTC::TimedDoubleSeq> out_{"out", sent_};
    RTC::InPort<RTC::TimedDoubleSeq> in_{"in", read_};
    RTC::CorbaPort provided_{"provided"}, required_{"required"};
    Echo servant_;
    RTC::CorbaConsumer<Bench::Echo> echo_;
};

extern "C" void BenchPathInit(RTC::Manager* manager) {
    coil::Properties profile;
    for (const char* key : {"implementation_id", "type_name"}) profile.setProperty(key, "BenchPath");
    profile.setProperty("category", "bench");
    manager->registerFactory(profile, RTC::Create<BenchPath>, RTC::Delete<BenchPath>);
}
