// SPDX-License-Identifier: Apache-2.0
// A module of components for rtm_host: those of components.hpp, and some that misbehave.
#include "components.hpp"
#include "ending_components.hpp"
#include "openrtm_components.hpp"
#include "talker.hpp"
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <thread>
#include <unistd.h>

namespace {

using namespace testing;

void print_line(const char* line) {
    std::puts(line);
    std::fflush(stdout);
}

/// An Accumulator that prints `received N` once, as soon as N is 10 or more, and its end.
class Reporter : public Accumulator {
  public:
    using Accumulator::Accumulator;
    RTC::ReturnCode_t onExecute(RTC::UniqueId id) override {
        Accumulator::onExecute(id);
        if (received_ >= 10 && !reported_) {
            std::printf("received 10\n"); // also where a late cycle has read the eleventh with it
            std::fflush(stdout);
            reported_ = true;
        }
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onDeactivated(RTC::UniqueId) override {
        std::printf("%s deactivated\n", getInstanceName());
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onFinalize() override {
        std::printf("%s finalized\n", getInstanceName());
        return RTC::RTC_OK;
    }

  private:
    bool reported_ = false;
};

class Thrower : public RTC::DataFlowComponentBase {
  public:
    using DataFlowComponentBase::DataFlowComponentBase;
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override { throw std::runtime_error("on purpose"); }
    RTC::ReturnCode_t onAborting(RTC::UniqueId) override {
        print_line("aborting");
        return RTC::RTC_OK;
    }
};

/// Removes component Reporter0 while this component is being finalized.
class Remover : public RTC::DataFlowComponentBase {
  public:
    using DataFlowComponentBase::DataFlowComponentBase;
    RTC::ReturnCode_t onFinalize() override {
        RTC::Manager::instance().deleteComponent("Reporter0");
        return RTC::RTC_OK;
    }
};

class HangingComponent : public RTC::DataFlowComponentBase {
  public:
    using DataFlowComponentBase::DataFlowComponentBase;
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        print_line("hanging");
        std::this_thread::sleep_for(std::chrono::hours(1));
        return RTC::RTC_OK;
    }
};

/// Its InPort `dies` ends the process in notify_connect(), `hangs` does not return from it; `dies_late` and
/// `hangs_late` do so in notify_disconnect(); `aborts` crashes with its first message, `aborts_later` with its third, and
/// the service `calculator` in set_mode().
class BadPeer : public RTC::DataFlowComponentBase {
  public:
    explicit BadPeer(RTC::Manager* manager)
        : DataFlowComponentBase(manager), dies_("dies", value_), hangs_("hangs", value_),
          dies_late_("dies_late", value_), hangs_late_("hangs_late", value_), aborts_("aborts", value_),
          aborts_later_("aborts_later", value_), calculator_port_("calculator") {}
    RTC::ReturnCode_t onInitialize() override {
        struct Die : RTC::ConnectionCallback {
            void operator()(RTC::ConnectorProfile&) override { std::_Exit(3); }
        };
        struct Hang : RTC::ConnectionCallback {
            void operator()(RTC::ConnectorProfile&) override {
                std::this_thread::sleep_for(std::chrono::hours(1));
            }
        };
        static Die die;
        static Hang hang;
        dies_.setOnPublishInterfaces(&die);
        hangs_.setOnPublishInterfaces(&hang);
        addInPort("dies", dies_);
        addInPort("hangs", hangs_);
        dies_late_.setOnUnsubscribeInterfaces(&die);
        hangs_late_.setOnUnsubscribeInterfaces(&hang);
        addInPort("dies_late", dies_late_);
        addInPort("hangs_late", hangs_late_);
        struct Abort : RTC::ConnectorDataListenerT<RTC::TimedLong> {
            ReturnCode operator()(RTC::ConnectorInfo&, RTC::TimedLong&) override {
                if (--messages == 0) std::abort();
                return NO_CHANGE;
            }
            explicit Abort(int after) : messages(after) {}
            int messages;
        };
        aborts_.addConnectorDataListener(RTC::ConnectorDataListenerType::ON_RECEIVED, new Abort(1));
        aborts_later_.addConnectorDataListener(RTC::ConnectorDataListenerType::ON_RECEIVED, new Abort(3));
        addInPort("aborts", aborts_);
        addInPort("aborts_later", aborts_later_);
        calculator_port_.registerProvider("calc", "Testing::Calculator", calculator_);
        addPort(calculator_port_);
        return RTC::RTC_OK;
    }

  private:
    struct AbortingCalculator : Calculator {
        void set_mode(Testing::Mode) override { std::abort(); }
    };
    RTC::TimedLong value_{};
    RTC::InPort<RTC::TimedLong> dies_, hangs_, dies_late_, hangs_late_, aborts_, aborts_later_;
    RTC::CorbaPort calculator_port_;
    AbortingCalculator calculator_;
};

/// Misbehaves in the callback that the property `in` names, in the way that `how` names: std, int, corba: throws a
/// std::exception, an int, a CORBA exception; exit, abort: ends the process; fail: returns RTC_ERROR, and its
/// destructor does not return; static: creates a static object whose destructor does not return; stdin: reads from
/// a pipe without data; otherwise does not return.
class FaultInjector : public RTC::DataFlowComponentBase {
  public:
    using DataFlowComponentBase::DataFlowComponentBase;
    ~FaultInjector() override {
        if (failed_) std::this_thread::sleep_for(std::chrono::hours(1));
    }
    RTC::ReturnCode_t onInitialize() override { return at("initialize"); }
    RTC::ReturnCode_t onFinalize() override { return at("finalize"); }
    RTC::ReturnCode_t onStartup(RTC::UniqueId) override { return at("startup"); }
    RTC::ReturnCode_t onShutdown(RTC::UniqueId) override { return at("shutdown"); }
    RTC::ReturnCode_t onActivated(RTC::UniqueId) override { return at("activated"); }
    RTC::ReturnCode_t onDeactivated(RTC::UniqueId) override { return at("deactivated"); }
    RTC::ReturnCode_t onAborting(RTC::UniqueId) override { return at("aborting"); }
    RTC::ReturnCode_t onError(RTC::UniqueId) override { return at("error"); }
    RTC::ReturnCode_t onReset(RTC::UniqueId) override { return at("reset"); }
    RTC::ReturnCode_t onStateUpdate(RTC::UniqueId) override { return at("update"); }
    RTC::ReturnCode_t onRateChanged(RTC::UniqueId) override { return at("rate"); }
    RTC::ReturnCode_t onExecute(RTC::UniqueId id) override {
        at("execute");
        if (in() == "rate" && getExecutionRate(id) < 500) setExecutionRate(id, 500);
        return in() == "aborting" || in() == "error" ? RTC::RTC_ERROR : RTC::RTC_OK;
    }

  private:
    bool failed_ = false;
    std::string in() { return getProperties().getProperty("in"); }
    RTC::ReturnCode_t at(const std::string& callback) {
        if (in() != callback) return RTC::RTC_OK;
        const std::string how = getProperties().getProperty("how");
        if (how == "std") throw std::runtime_error("on purpose");
        if (how == "int") throw 7;
        if (how == "corba") throw CORBA::NO_MEMORY();
        if (how == "exit") std::exit(7);
        if (how == "fail") {
            failed_ = true;
            return RTC::RTC_ERROR;
        }
        if (how == "static") {
            static const struct Slow {
                ~Slow() { std::this_thread::sleep_for(std::chrono::hours(1)); }
            } slow;
            print_line("is there");
            return RTC::RTC_OK;
        }
        if (how == "stdin") { // holds the lock of the stream for ever
            int ends[2];
            if (pipe(ends) != 0) std::abort();
            dup2(ends[0], STDIN_FILENO);
            print_line("reads");
            int number = 0;
            std::cin >> number;
        }
        if (how == "abort") std::abort();
        print_line("asleep");
        std::this_thread::sleep_for(std::chrono::hours(1));
        return RTC::RTC_OK;
    }
};

/// A device, a camera for instance, that needs `ms` milliseconds in the callback that the property `in` names. With
/// `fails` that callback then fails; with `breaks` onExecute does.
class SlowDevice : public RTC::DataFlowComponentBase {
  public:
    using DataFlowComponentBase::DataFlowComponentBase;
    RTC::ReturnCode_t onInitialize() override { return at("initialize"); }
    RTC::ReturnCode_t onActivated(RTC::UniqueId) override { return at("activated"); }
    RTC::ReturnCode_t onDeactivated(RTC::UniqueId) override { return at("deactivated"); }
    RTC::ReturnCode_t onReset(RTC::UniqueId) override { return at("reset"); }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        return getProperties().getProperty("breaks").empty() ? RTC::RTC_OK : RTC::RTC_ERROR;
    }
    RTC::ReturnCode_t onFinalize() override {
        print_line("device closed");
        return RTC::RTC_OK;
    }

  private:
    RTC::ReturnCode_t at(const std::string& callback) {
        if (getProperties().getProperty("in") != callback) return RTC::RTC_OK;
        std::this_thread::sleep_for(std::chrono::milliseconds(std::stol(getProperties().getProperty("ms"))));
        return getProperties().getProperty("fails").empty() ? RTC::RTC_OK : RTC::RTC_ERROR;
    }
};

/// Forks a helper without exec(), a daemon that outlives its host, and prints `helper PID`.
class HelperForker : public RTC::DataFlowComponentBase {
  public:
    using DataFlowComponentBase::DataFlowComponentBase;
    RTC::ReturnCode_t onActivated(RTC::UniqueId) override {
        const pid_t helper = fork();
        if (helper == 0) {
            setsid();
            for (int stream = 0; stream < 3; ++stream) close(stream);
            sleep(300);
            _exit(0);
        }
        print_line(("helper " + std::to_string(helper)).c_str());
        return RTC::RTC_OK;
    }
};

/// Logs 80 KB in each cycle, and prints `logged` after 100 cycles.
class Chatterbox : public RTC::DataFlowComponentBase {
  public:
    using DataFlowComponentBase::DataFlowComponentBase;
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        const std::string text(4000, 'x');
        for (int line = 0; line < 20; ++line) RTC_INFO(("%s", text.c_str()));
        if (++cycles_ == 100) print_line("logged");
        return RTC::RTC_OK;
    }

  private:
    int cycles_ = 0;
};

} // namespace

extern "C" void TestComponentsInit(RTC::Manager* manager) {
    register_test_components(*manager);
    register_component_type<Reporter>(*manager, "Reporter");
    register_component_type<Thrower>(*manager, "Thrower");
    register_component_type<Remover>(*manager, "Remover");
    register_component_type<HangingComponent>(*manager, "HangingComponent");
    register_component_type<FaultInjector>(*manager, "FaultInjector");
    register_component_type<BadPeer>(*manager, "BadPeer");
    register_component_type<Talker>(*manager, "Talker");
    register_openrtm_components(*manager);
    register_ending_components(*manager);
    register_component_type<SlowDevice>(*manager, "SlowDevice");
    register_component_type<HelperForker>(*manager, "HelperForker");
    register_component_type<Chatterbox>(*manager, "Chatterbox");
}
extern "C" void OnlyReporters(RTC::Manager* manager) {
    register_component_type<Reporter>(*manager, "Reporter");
}
