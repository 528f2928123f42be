// SPDX-License-Identifier: Apache-2.0
// State machines of components (StaticFSM.h, Macho.h): an oven, with events that come through a port.
#include "tests/host/rtm/manager_fixture.hpp"
#include <rtm/EventPort.h>

using namespace testing;

namespace oven {

// The entries (+State) and exits (-State) since the last take_record().
std::string& record() {
    static auto* all = new std::string;
    return *all;
}
RTC::ReturnCode_t add(const std::string& what) {
    record() += what + " ";
    return RTC::RTC_OK;
}

FSM_TOPSTATE(Top) {
    struct Box {
        int minutes = 0;
    };
    FSM_STATE(Top);
    virtual void open() {}
    virtual void close() {}
    virtual void minutes(RTC::TimedLong) {}
    virtual void start() {}
    virtual void tick() {}

  private:
    RTC::ReturnCode_t onInit() override;
    RTC::ReturnCode_t onEntry() override { return add("+Top"); }
};

FSM_SUBSTATE(Open, Top) {
    FSM_STATE(Open);
    void close() override;
    RTC::ReturnCode_t onEntry() override { return add("+Open"); }
    RTC::ReturnCode_t onExit() override { return add("-Open"); }
};

FSM_SUBSTATE(Closed, Top) {
    FSM_STATE(Closed);
    DEEPHISTORY();
    void open() override { setState<Open>(); }
    RTC::ReturnCode_t onInit() override;
    RTC::ReturnCode_t onEntry() override { return add("+Closed"); }
    RTC::ReturnCode_t onExit() override { return add("-Closed"); }
};

FSM_SUBSTATE(Idle, Closed) {
    FSM_STATE(Idle);
    void minutes(RTC::TimedLong time) override;
    RTC::ReturnCode_t onEntry() override {
        TOP::box().minutes = 0;
        return add("+Idle");
    }
    RTC::ReturnCode_t onExit() override { return add("-Idle"); }
};

FSM_SUBSTATE(Programmed, Closed) {
    FSM_STATE(Programmed);
    void minutes(RTC::TimedLong time) override { TOP::box().minutes += time.data; }
    void start() override;
    RTC::ReturnCode_t onEntry() override { return add("+Programmed"); }
    RTC::ReturnCode_t onExit() override { return add("-Programmed"); }
};

FSM_SUBSTATE(Heating, Programmed) {
    FSM_STATE(Heating);
    void tick() override {
        if (--TOP::box().minutes == 0) setState<Idle>();
    }
    RTC::ReturnCode_t onEntry() override { return add("+Heating"); }
    RTC::ReturnCode_t onExit() override { return add("-Heating"); }
};

RTC::ReturnCode_t Top::onInit() {
    setState<Closed>();
    return RTC::RTC_OK;
}
RTC::ReturnCode_t Closed::onInit() {
    setState<Idle>();
    return RTC::RTC_OK;
}
void Open::close() { setStateHistory<Closed>(); }
void Idle::minutes(RTC::TimedLong time) {
    setState<Programmed>();
    dispatch(Event(&TOP::minutes, time)); // handled by the new state
}
void Programmed::start() { setState<Heating>(); }

} // namespace oven

FSM_INIT_VALUE(oven::Top)
FSM_INIT_VALUE(oven::Idle)

namespace {

std::string take_record() { return std::exchange(oven::record(), ""); }

RTC::TimedLong minutes(long n) {
    RTC::TimedLong time{};
    time.data = static_cast<CORBA::Long>(n);
    return time;
}

struct Oven : RTC::DataFlowComponentBase {
    explicit Oven(RTC::Manager* m) : DataFlowComponentBase(m), fsm(this), events("event", fsm) {}
    RTC::ReturnCode_t onInitialize() override {
        addInPort("event", events);
        events.bindEvent("open", &oven::Top::open);
        events.bindEvent("close", &oven::Top::close);
        events.bindEvent("minutes", &oven::Top::minutes);
        events.bindEvent("start", &oven::Top::start);
        events.bindEvent("tick", &oven::Top::tick);
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        fsm.run_event();
        return RTC::RTC_OK;
    }
    RTC::Machine<oven::Top> fsm;
    RTC::EventInPort<RTC::Machine<oven::Top>> events;
};

} // namespace

TEST_CASE("A machine enters, initializes and leaves states in the order of their hierarchy") {
    Macho::Machine<oven::Top> machine;
    CHECK(take_record() == "+Top +Closed +Idle ");
    CHECK(oven::Idle::isCurrent(machine));
    CHECK(oven::Closed::isCurrent(machine));
    CHECK_FALSE(oven::Closed::isCurrentDirect(machine));
    CHECK(std::string(machine.currentState().name()) == "Idle");

    machine->start(); // Idle does not handle start
    CHECK(take_record().empty());
    machine->minutes(minutes(2));
    CHECK(take_record() == "-Idle +Programmed ");
    CHECK(machine.box().minutes == 2); // dispatched to the state that was entered
    machine->start();
    CHECK(take_record() == "+Heating ");
    machine->open(); // handled by a superstate
    CHECK(take_record() == "-Heating -Programmed -Closed +Open ");
    machine->close(); // back to its last state, by history
    CHECK(take_record() == "-Open +Closed +Programmed +Heating ");
    machine->tick();
    CHECK(take_record().empty());
    machine->tick();
    CHECK(take_record() == "-Heating -Programmed +Idle ");

    machine.dispatch(Macho::Event(&oven::Top::minutes, minutes(1)));
    CHECK(oven::Programmed::isCurrentDirect(machine));
    const auto kept = machine.currentState();
    machine->start();
    machine.setState(kept);
    CHECK(take_record() == "-Idle +Programmed +Heating -Heating -Programmed +Programmed ");
    machine->open();
    oven::Closed::clearHistory(machine);
    machine->close();
    CHECK(oven::Idle::isCurrentDirect(machine));
}

namespace plain {

TOPSTATE(Top) {
    STATE(Top);
    virtual void go(int) {}
    virtual void back() {}

  protected:
    void init() override;
};
SUBSTATE(Here, Top) {
    STATE(Here);
    void go(int n) override;
};
SUBSTATE(There, Top) {
    struct Box {
        int visits = 0, last = 0;
    };
    STATE(There);
    PERSISTENT();
    void back() override { setState<Here>(); }

    void entry() override { ++box().visits; }
    using LINK::init;
    void init(int n) { box().last = n; }
    int visits() { return box().visits; }
    int last() { return box().last; }
};
void Top::init() { setState<Here>(); }
void Here::go(int n) { setState<There>(n); }

} // namespace plain

TEST_CASE("States have data, and values can be handed to the state that is entered") {
    Macho::Machine<plain::Top> machine;
    CHECK(plain::Here::isCurrentDirect(machine));
    machine->go(7);
    REQUIRE(plain::There::isCurrentDirect(machine));
    machine->back();
    machine->go(8);
    machine.setState(Macho::State<plain::There>(9)); // left and entered again
    auto& there = static_cast<plain::There&>(machine._current().specification());
    CHECK(there.visits() == 3);
    CHECK(there.last() == 9);
}

TEST_CASE(
    "Events come through a port, each over the connection that names it, and run in the component's cycle") {
    ManagerFixture fixture;
    register_component_type<Oven>(fixture.manager(), "Oven");
    auto& rtc = fixture.create<Oven>("Oven");
    auto& buttons = fixture.create<Recorder>("Recorder");
    RTC::TimedLong value{};
    RTC::OutPort<RTC::TimedLong> minute("minute", value), start("start", value), tick("tick", value);
    for (auto* port : {&minute, &start, &tick}) buttons.addOutPort(port->name(), *port);
    fixture.connect("Recorder0.minute?port=Oven0.event&fsm_event_name=minutes");
    fixture.connect("Recorder0.start?port=Oven0.event&fsm_event_name=start");
    fixture.connect("Recorder0.tick?port=Oven0.event&fsm_event_name=tick&interface_type=direct");
    fixture.activate(rtc);
    take_record();

    value.data = 1;
    CHECK(minute.write());
    CHECK(start.write());
    CHECK(take_record().empty());
    fixture.step(rtc);
    CHECK(take_record() == "-Idle +Programmed +Heating ");
    CHECK(rtc.fsm.box().minutes == 1);
    tick.write();
    fixture.step(rtc);
    CHECK(take_record() == "-Heating -Programmed +Idle ");
    for (auto* port : {&minute, &start, &tick}) buttons.removePort(*port);
}

namespace {

/// Appends the names of entered states, `!` after one that has failed.
struct EntryListener : RTC::PostFsmActionListener {
    explicit EntryListener(std::string& s) : entered(s) {}
    void operator()(const char* state, RTC::ReturnCode_t ret) override {
        entered += state + std::string(ret == RTC::RTC_OK ? " " : "! ");
    }
    std::string& entered;
};

} // namespace

TEST_CASE("A component's listeners are called for the states its machine enters, and its queue of events is "
          "bounded") {
    ManagerFixture fixture;
    register_component_type<Oven>(fixture.manager(), "Oven");
    auto& rtc = fixture.create<Oven>("Oven");
    std::string entered;
    rtc.addPostFsmActionListener(RTC::PostFsmActionListenerType::POST_ON_ENTRY, new EntryListener(entered));
    rtc.fsm->open();
    CHECK(entered == "Open ");

    coil::Properties buffer;
    buffer.setProperty("length", "2");
    buffer.setProperty("write.full_policy", "do_nothing");
    rtc.fsm.getBuffer().init(buffer);
    int handled = 0;
    CHECK(rtc.fsm.getBuffer().put([&] { handled += 1; }));
    CHECK(rtc.fsm.getBuffer().put([&] { handled += 10; }));
    CHECK_FALSE(rtc.fsm.getBuffer().put([&] { handled += 100; }));
    rtc.fsm.run_event();
    CHECK(handled == 11);
}
