// SPDX-License-Identifier: Apache-2.0
// Components for the tests, written as users write theirs, and their registration.
#pragma once
#include "CalculatorSkel.h"
#include <atomic>
#include <numeric>
#include <rtm/CorbaPort.h>
#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/Manager.h>
#include <rtm/idl/BasicDataTypeSkel.h>

namespace testing {

/// Sends 1, 2, 3 ... on `out`, one value per cycle; the parameter `step` is the difference.
class Counter : public RTC::DataFlowComponentBase {
  public:
    explicit Counter(RTC::Manager* manager) : DataFlowComponentBase(manager), out_("out", value_) {}
    RTC::ReturnCode_t onInitialize() override {
        addOutPort("out", out_);
        bindParameter("step", step_, "1");
        value_.data = 0;
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        value_.data += step_;
        setTimestamp(value_);
        out_.write();
        return RTC::RTC_OK;
    }
    RTC::TimedLong value_{};
    int step_ = 0;
    RTC::OutPort<RTC::TimedLong> out_;
};

/// Reads all values of `in` in each cycle; counts them and adds them up.
class Accumulator : public RTC::DataFlowComponentBase {
  public:
    explicit Accumulator(RTC::Manager* manager) : DataFlowComponentBase(manager), in_("in", value_) {}
    RTC::ReturnCode_t onInitialize() override {
        addInPort("in", in_);
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        while (in_.isNew()) {
            in_.read();
            sum_ += value_.data;
            ++received_;
        }
        return RTC::RTC_OK;
    }
    RTC::TimedLong value_{};
    RTC::InPort<RTC::TimedLong> in_;
    std::atomic<long> sum_{0}, received_{0};
};

/// The servant of CalculatorProvider.
class Calculator : public POA_Testing::Calculator, public PortableServer::RefCountServantBase {
  public:
    char* name() override { return CORBA::string_dup("calculator"); }
    CORBA::Double sum(const Testing::Numbers& values) override {
        ++calls_;
        return std::accumulate(values.get_buffer(), values.get_buffer() + values.length(), 0.0);
    }
    Testing::Range range_of(const Testing::Numbers& values) override {
        ++calls_;
        Testing::Range range{0, 0};
        for (CORBA::ULong i = 0; i < values.length(); ++i) {
            range.low = i == 0 ? values[i] : std::min(range.low, values[i]);
            range.high = i == 0 ? values[i] : std::max(range.high, values[i]);
        }
        return range;
    }
    CORBA::Long divide(CORBA::Long dividend, CORBA::Long divisor, CORBA::Long& rest) override {
        rest = dividend % divisor;
        return dividend / divisor;
    }
    void set_mode(Testing::Mode) override {}
    CORBA::Long calls() override { return calls_; }
    void calls(CORBA::Long n) override { calls_ = n; }
    RTC::TimedDouble stamped(const RTC::TimedDouble& value) override { return value; }

  private:
    std::atomic<CORBA::Long> calls_{0};
};

/// Provides the service Testing::Calculator on the port `calculator`.
class CalculatorProvider : public RTC::DataFlowComponentBase {
  public:
    explicit CalculatorProvider(RTC::Manager* manager)
        : DataFlowComponentBase(manager), port_("calculator") {}
    RTC::ReturnCode_t onInitialize() override {
        port_.registerProvider("calc", "Testing::Calculator", servant_);
        addPort(port_);
        return RTC::RTC_OK;
    }
    RTC::CorbaPort port_;
    Calculator servant_;
};

/// Uses a Testing::Calculator through the port `calculator`.
class CalculatorConsumer : public RTC::DataFlowComponentBase {
  public:
    explicit CalculatorConsumer(RTC::Manager* manager)
        : DataFlowComponentBase(manager), port_("calculator") {}
    RTC::ReturnCode_t onInitialize() override {
        port_.registerConsumer("calc", "Testing::Calculator", calculator_);
        addPort(port_);
        return RTC::RTC_OK;
    }
    RTC::CorbaPort port_;
    RTC::CorbaConsumer<Testing::Calculator> calculator_;
};

/// Records the names of its callbacks; fails or throws in those that the test names. The record is static, so
/// that it outlives the component.
class Recorder : public RTC::DataFlowComponentBase {
  public:
    explicit Recorder(RTC::Manager* manager) : DataFlowComponentBase(manager) {}
    RTC::ReturnCode_t onInitialize() override { return record("initialize"); }
    RTC::ReturnCode_t onFinalize() override { return record("finalize"); }
    RTC::ReturnCode_t onStartup(RTC::UniqueId) override { return record("startup"); }
    RTC::ReturnCode_t onShutdown(RTC::UniqueId) override { return record("shutdown"); }
    RTC::ReturnCode_t onActivated(RTC::UniqueId) override { return record("activated"); }
    RTC::ReturnCode_t onDeactivated(RTC::UniqueId) override { return record("deactivated"); }
    RTC::ReturnCode_t onAborting(RTC::UniqueId) override { return record("aborting"); }
    RTC::ReturnCode_t onError(RTC::UniqueId) override { return record("error"); }
    RTC::ReturnCode_t onReset(RTC::UniqueId) override { return record("reset"); }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override { return record("execute"); }
    RTC::ReturnCode_t onStateUpdate(RTC::UniqueId) override { return record("update"); }
    RTC::ReturnCode_t onRateChanged(RTC::UniqueId) override { return record("rate"); }

    /// The callbacks since the last call of this function, separated by blanks.
    static std::string take_calls() { return std::exchange(calls(), ""); }
    /// Callbacks that fail, separated by blanks.
    static std::string& failing_callback() {
        static auto* callback = new std::string;
        return *callback;
    }
    /// If set, the callbacks throw; otherwise they return RTC_ERROR.
    static bool& throws_exception() {
        static bool yes = false;
        return yes;
    }

  private:
    // Never deleted: components of a static ManagerFixture record callbacks while static objects are destroyed.
    static std::string& calls() {
        static auto* all = new std::string;
        return *all;
    }
    static RTC::ReturnCode_t record(const char* callback) {
        calls() += std::string(calls().empty() ? "" : " ") + callback;
        const std::string failing = " " + failing_callback() + " ";
        if (failing.find(std::string(" ") + callback + " ") == std::string::npos) return RTC::RTC_OK;
        if (throws_exception()) throw std::runtime_error("as told");
        return RTC::RTC_ERROR;
    }
};

/// Registers a component type as a module's init function does.
template <class Component>
void register_component_type(RTC::Manager& manager, const char* name) {
    coil::Properties profile;
    for (const char* key : {"implementation_id", "type_name"}) profile.setProperty(key, name);
    profile.setProperty("description", "for tests");
    profile.setProperty("version", "1.0");
    profile.setProperty("vendor", "Tandem");
    profile.setProperty("category", "test");
    profile.setProperty("conf.default.step", "1");
    manager.registerFactory(profile, RTC::Create<Component>, RTC::Delete<Component>);
}

inline void register_test_components(RTC::Manager& manager) {
    register_component_type<Counter>(manager, "Counter");
    register_component_type<Accumulator>(manager, "Accumulator");
    register_component_type<CalculatorProvider>(manager, "CalculatorProvider");
    register_component_type<CalculatorConsumer>(manager, "CalculatorConsumer");
    register_component_type<Recorder>(manager, "Recorder");
}

} // namespace testing
