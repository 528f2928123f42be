// SPDX-License-Identifier: Apache-2.0
// Creates, connects and drives RTCs of the manager that its property `manager` names, once, and prints what it sees. Then ends the RTC
// that its property `exits` names.
#include <OPRoSInclude.h>
#include <ServiceUtils.h>

#include <RtcConnectorRequired.h>
#include <RtcManagerRequired.h>

#include <chrono>
#include <functional>
#include <iostream>
#include <syncstream>
#include <thread>

class BossComp : public Component {
  public:
    BossComp() {
        addPort("manager", manager_);
        addPort("connector", connector_);
    }

    ReturnType onExecute() override {
        if (done_) return OPROS_SUCCESS;
        done_ = true;
        attempt("work", [this] { work(); });
        std::osyncstream(std::cout) << "boss is done" << std::endl;
        return OPROS_SUCCESS;
    }

  protected:
    ReturnType onInitialize() override { return OPROS_SUCCESS; }
    ReturnType onStart() override { return OPROS_SUCCESS; }
    ReturnType onStop() override { return OPROS_SUCCESS; }
    ReturnType onDestroy() override { return OPROS_SUCCESS; }

  private:
    static void attempt(const std::string& what, const std::function<void()>& step) {
        try {
            step();
        } catch (const MethodInvokeException& error) {
            std::osyncstream(std::cout) << what << ": " << error.what() << std::endl;
        }
    }
    static void print(const std::string& what, const RtcManagerRequired::Names& names) {
        std::osyncstream line(std::cout);
        line << what << ":";
        for (const auto& name : names) line << " " << name;
        line << std::endl;
    }
    void print_state(const std::string& rtc) {
        std::osyncstream(std::cout) << rtc << " is " << manager_->state(rtc) << std::endl;
    }

    void work() {
        const std::string at = getProperty("manager");
        manager_->load(at, getProperty("module"));
        const std::string motor = manager_->create(at, "ServoRtc"), other = manager_->create(at, "ServoRtc");
        print("created", {motor, other});
        print("all", manager_->list(at));
        manager_->configure(motor, "gain", "3");
        attempt("configure", [&] { manager_->configure(motor, "gian", "3"); });
        connector_->connect(motor + ".out", other + ".in", {"subscription_type=flush"});
        print("connections", connector_->connections(motor + ".out"));
        attempt("connect", [&] { connector_->connect(motor + ".out", other + ".nothing", {}); });
        manager_->activate(other);
        manager_->activate(motor);
        print_state(motor);
        manager_->configure(other, "fails", "1");
        for (int i = 0; i < 1000 && manager_->state(other) != "ERROR"; ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        attempt("activate", [&] { manager_->activate(other); });
        manager_->reset(other);
        print_state(other);
        manager_->deactivate(motor);
        print_state(motor);
        connector_->disconnect(motor + ".out", other + ".in");
        attempt("disconnect", [&] { connector_->disconnect(motor + ".out", other + ".in"); });
        manager_->exit(other);
        attempt("state", [&] { manager_->state(other); });
        attempt("create", [&] { manager_->create(at, "NoSuchRtc"); });
        attempt("nobody", [&] { manager_->list("127.0.0.1:1"); });
        if (const std::string last = getProperty("exits"); !last.empty()) {
            manager_->exit(last);
            print("exits", {last});
        }
    }

    bool done_ = false;
    RtcManagerRequired* manager_ = new RtcManagerRequired; // the component deletes its service ports
    RtcConnectorRequired* connector_ = new RtcConnectorRequired;
};

extern "C" {
Component* getComponent() { return new BossComp; }
void releaseComponent(Component* component) { delete component; }
}
