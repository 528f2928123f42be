// SPDX-License-Identifier: Apache-2.0
// Components that end their own manager.
#include "ending_components.hpp"
#include "components.hpp"
#include <cstdio>
#include <thread>

namespace {

void say(const char* line) {
    std::puts(line);
    std::fflush(stdout);
}

void end_manager() {
    RTC::Manager::instance().shutdown();
    say("shutdown returned");
}

class EndingCalculator : public testing::Calculator {
  public:
    void set_mode(Testing::Mode) override { end_manager(); }
};

/// Ends the manager by shutdown() in the place that the property `in` names: a callback, its destructor, a task of the
/// manager, a thread that it starts, even during the set-up, or a call of its service. Prints the callbacks of the end.
class Ender : public RTC::DataFlowComponentBase {
  public:
    explicit Ender(RTC::Manager* manager) : DataFlowComponentBase(manager), port_("calculator") {}
    ~Ender() override {
        at("destructor");
        if (thread_.joinable()) thread_.join();
        say("deleted");
    }
    RTC::ReturnCode_t onInitialize() override {
        in_ = getProperties().getProperty("in");
        port_.registerProvider("calc", "Testing::Calculator", servant_);
        addPort(port_);
        if (in_ == "set-up") std::thread(end_manager).join();
        return at("initialize");
    }
    RTC::ReturnCode_t onActivated(RTC::UniqueId) override { return at("activated"); }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        if (++cycles_ != 5) return RTC::RTC_OK;
        if (in_ == "task") RTC::Manager::instance().invoke(end_manager);
        if (in_ == "thread") thread_ = std::thread(end_manager);
        if (in_ == "service") thread_ = std::thread([this] { call_service(); });
        if (in_ == "finalize" || in_ == "destructor") exit();
        return at("execute");
    }
    RTC::ReturnCode_t onDeactivated(RTC::UniqueId) override {
        say("deactivated");
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onFinalize() override {
        say("finalized");
        return at("finalize");
    }

  private:
    RTC::ReturnCode_t at(const std::string& place) {
        if (in_ == place) end_manager();
        return RTC::RTC_OK;
    }
    void call_service() {
        Testing::Calculator_var service = servant_._this();
        service->set_mode(Testing::Mode());
    }

    std::string in_;
    int cycles_ = 0;
    std::thread thread_;
    RTC::CorbaPort port_;
    EndingCalculator servant_;
};

} // namespace

void register_ending_components(RTC::Manager& manager) {
    testing::register_component_type<Ender>(manager, "Ender");
}
