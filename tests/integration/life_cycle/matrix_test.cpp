// SPDX-License-Identifier: Apache-2.0
// Every arrow of the drawing in docs/life_cycle.md, with two components on each side.
#include "tests/apps/tandem/program.hpp"
#include "tests/integration/two_hosts.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include <iostream>
#include <sstream>

namespace {

/// ServoRtc0 and ServoRtc1 behind the link, Motor and Pump shown as RTCs, and a component that drives its application.
class LifeCycleHosts : public TwoHosts {
  public:
    LifeCycleHosts() : port_(unused_port()) {
        std::filesystem::copy_file(TEST_SOURCES "/life_cycle/TransitionComp.xml",
                                   folder() / "TransitionComp.xml");
        set_talker("");
        set_connections("");
        set_rtc("ServoRtc");
        add_rtc("ServoRtc");
        set_interceptor("rtc=ServoRtc0;ServoRtc1");
        set_manager_port(port_);
        set_strict(false);
        set_adaptor_properties(property("share", "Motor, Pump"));
        add_component("Motor", "MotorComp");
        add_component("Pump", "MotorComp");
        set_talker("TransitionComp");
        set_talker_properties(property("commands", (folder() / "commands").string()));
    }
    void start_both() {
        start_rtm();
        start_opros();
    }
    void start_opros() {
        std::ofstream(folder() / "commands");
        commands_ = 0;
        TwoHosts::start_opros();
    }

    /// Makes a transition of an OPRoS component. Returns what TransitionComp says, `Motor is ACTIVE`, or the reason why not.
    std::string opros(const std::string& verb, const std::string& name) {
        const std::string number = std::to_string(++commands_) + "-" + std::to_string(getpid()) + unique();
        std::ofstream(folder() / "commands", std::ios::app) << number << " " << verb << " " << name << "\n";
        const std::string answer = "transition " + number + ": ";
        if (!says("opros", answer)) return "no answer";
        const std::string all = output("opros");
        const auto begin = all.find(answer) + answer.size();
        return all.substr(begin, all.find('\n', begin) - begin);
    }
    int rtm(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "rtm");
        arguments.insert(arguments.end(), {"--manager", "127.0.0.1:" + port_});
        return tandem::test::tandem_program(arguments).exit_code;
    }
    /// `Motor ACTIVE`; of all RTCs of the manager.
    std::map<std::string, std::string> rtc_states() const {
        const auto list =
            tandem::test::tandem_program({"rtm", "list", "--json", "--manager", "127.0.0.1:" + port_});
        std::map<std::string, std::string> states;
        if (list.exit_code != 0) return states;
        for (const auto& entry : list.json()) states[entry["instance"]] = entry["state"];
        return states;
    }

    struct Expected {
        std::map<std::string, std::string> opros, rtm;
    };
    /// Waits for these states. Returns what is otherwise; empty if all came.
    std::string differs(const Expected& expected) {
        std::string difference;
        for (int i = 0; i < 300; ++i) {
            difference.clear();
            const auto rtcs = expected.rtm.empty() ? std::map<std::string, std::string>() : rtc_states();
            for (const auto& [name, state] : expected.rtm) {
                const auto at = rtcs.find(name);
                const std::string is = at == rtcs.end() ? "gone" : at->second;
                if (is != state) difference += "; RTC " + name + " is " + is + ", not " + state;
            }
            for (const auto& [name, state] : expected.opros) {
                const std::string is = opros("state", name);
                if (is != name + " is " + state) difference += "; " + is + ", not " + state;
            }
            if (difference.empty()) return "";
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
        return difference;
    }

  private:
    static std::string unique() {
        static int number = 0;
        return "-" + std::to_string(++number);
    }
    std::string port_;
    int commands_ = 0;
};

/// One arrow of the drawing.
struct Arrow {
    std::string name;
    std::function<void()> act;
    LifeCycleHosts::Expected expected;
};

/// Follows arrows and counts them.
class Walk {
  public:
    explicit Walk(LifeCycleHosts& hosts) : hosts_(hosts) {}

    void follow(const std::vector<Arrow>& arrows) {
        for (const auto& arrow : arrows) {
            ++cells_;
            const auto before = std::pair(hosts_.output("opros").size(), hosts_.output("rtm").size());
            arrow.act();
            const std::string difference = hosts_.differs(arrow.expected);
            if (difference.empty()) continue;
            ++failed_;
            FAIL_CHECK(arrow.name << difference << "\nopros_host:\n"
                                  << without_transitions(hosts_.output("opros").substr(before.first))
                                  << "rtm_host:\n"
                                  << hosts_.output("rtm").substr(before.second));
        }
    }
    int cells() const { return cells_; }
    int failed() const { return failed_; }

  private:
    static std::string without_transitions(const std::string& output) {
        std::string kept, line;
        for (std::istringstream lines(output); std::getline(lines, line);)
            if (line.find("transition ") != 0) kept += line + "\n";
        return kept;
    }

    LifeCycleHosts& hosts_;
    int cells_ = 0, failed_ = 0;
};

/// AdaptorComp's state, and those of the two RTCs behind InterceptorComp.
LifeCycleHosts::Expected adaptor(const std::string& state, const std::string& first,
                                 const std::string& second) {
    return {{{"Adaptor", state}}, {{"ServoRtc0", first}, {"ServoRtc1", second}}};
}

/// The states of an OPRoS component, of its RTC, and of another component, which must not change.
LifeCycleHosts::Expected shared(const std::string& name, const std::string& state, const std::string& rtc) {
    const std::string other = name == "Motor" ? "Pump" : "Motor";
    return {{{name, state}, {other, "ACTIVE"}}, {{name, rtc}, {other, "ACTIVE"}}};
}

std::vector<Arrow> arrows_of_adaptor(LifeCycleHosts& hosts) {
    const auto opros = [&hosts](const char* verb) {
        return [&hosts, verb] { hosts.opros(verb, "Adaptor"); };
    };
    const auto rtm = [&hosts](std::vector<std::string> arguments) {
        return [&hosts, arguments = std::move(arguments)] { hosts.rtm(arguments); };
    };
    const auto fails = [&hosts] { // setting a parameter to its current value would change nothing
        hosts.rtm({"conf", "ServoRtc0", "fails=0"});
        hosts.rtm({"conf", "ServoRtc0", "fails=1"});
    };
    return {
        {"AdaptorComp stop: deactivates the RTCs", opros("stop"),
         adaptor("INACTIVE", "INACTIVE", "INACTIVE")},
        {"AdaptorComp start: activates the RTCs", opros("start"), adaptor("ACTIVE", "ACTIVE", "ACTIVE")},
        {"an RTC goes to ERROR: AdaptorComp goes to ERROR", fails, adaptor("ERROR", "ERROR", "ACTIVE")},
        {"AdaptorComp recover: resets the RTC in ERROR", opros("recover"),
         adaptor("READY", "INACTIVE", "ACTIVE")},
        {"AdaptorComp start after recover", opros("start"), adaptor("ACTIVE", "ACTIVE", "ACTIVE")},
        {"an RTC goes to ERROR again", fails, adaptor("ERROR", "ERROR", "ACTIVE")},
        {"AdaptorComp reset: resets and activates the RTC", opros("reset"),
         adaptor("ACTIVE", "ACTIVE", "ACTIVE")},
        {"an RTC goes to ERROR a third time", fails, adaptor("ERROR", "ERROR", "ACTIVE")},
        {"that RTC is reset by a tool: AdaptorComp waits", rtm({"reset", "ServoRtc0"}),
         adaptor("ERROR", "INACTIVE", "ACTIVE")},
        {"that RTC is activated by a tool: AdaptorComp is ACTIVE again", rtm({"activate", "ServoRtc0"}),
         adaptor("ACTIVE", "ACTIVE", "ACTIVE")},
        {"AdaptorComp goes to ERROR: the RTCs go on", opros("fail"), adaptor("ERROR", "ACTIVE", "ACTIVE")},
        {"AdaptorComp reset with RTCs that are ACTIVE", opros("reset"),
         adaptor("ACTIVE", "ACTIVE", "ACTIVE")},
        {"an RTC is deactivated by a tool: AdaptorComp goes on", rtm({"deactivate", "ServoRtc1"}),
         adaptor("ACTIVE", "ACTIVE", "INACTIVE")},
        {"an RTC is activated by a tool", rtm({"activate", "ServoRtc1"}),
         adaptor("ACTIVE", "ACTIVE", "ACTIVE")},
        {"AdaptorComp stop again", opros("stop"), adaptor("INACTIVE", "INACTIVE", "INACTIVE")},
        {"an RTC is activated by a tool: AdaptorComp stays INACTIVE", rtm({"activate", "ServoRtc0"}),
         adaptor("INACTIVE", "ACTIVE", "INACTIVE")},
        {"that RTC goes to ERROR: AdaptorComp stays INACTIVE", fails,
         adaptor("INACTIVE", "ERROR", "INACTIVE")},
        {"AdaptorComp start with an RTC in ERROR: fails, and the others are INACTIVE", opros("start"),
         adaptor("ERROR", "ERROR", "INACTIVE")},
        {"the RTC is reset by a tool: AdaptorComp stays in ERROR", rtm({"reset", "ServoRtc0"}),
         adaptor("ERROR", "INACTIVE", "INACTIVE")},
        {"AdaptorComp reset: activates the RTCs", opros("reset"), adaptor("ACTIVE", "ACTIVE", "ACTIVE")},
    };
}

std::vector<Arrow> arrows_of_shared(LifeCycleHosts& hosts, const std::string& name) {
    const auto opros = [&hosts, name](const char* verb) {
        return [&hosts, verb, name] { hosts.opros(verb, name); };
    };
    const auto rtm = [&hosts, name](const char* verb) {
        return [&hosts, verb, name] { hosts.rtm({verb, name}); };
    };
    const auto fails = [&hosts, name](const char* callback) {
        return [&hosts, callback, name] { hosts.rtm({"conf", name, std::string("fails=") + callback}); };
    };
    const auto then = [](std::function<void()> first, std::function<void()> second) {
        return [first = std::move(first), second = std::move(second)] {
            first();
            second();
        };
    };
    return {
        {name + ": deactivate stops it", rtm("deactivate"), shared(name, "INACTIVE", "INACTIVE")},
        {name + ": activate starts it", rtm("activate"), shared(name, "ACTIVE", "ACTIVE")},
        {name + ": it is stopped, its RTC becomes INACTIVE", opros("stop"),
         shared(name, "INACTIVE", "INACTIVE")},
        {name + ": it is started, its RTC becomes ACTIVE", opros("start"), shared(name, "ACTIVE", "ACTIVE")},
        {name + ": stopOnError, its RTC goes to ERROR", opros("fail"), shared(name, "ERROR", "ERROR")},
        {name + ": reset of the RTC recovers it", rtm("reset"), shared(name, "READY", "INACTIVE")},
        {name + ": activate after reset", rtm("activate"), shared(name, "ACTIVE", "ACTIVE")},
        {name + ": onExecute throws, its RTC goes to ERROR", fails("execute"),
         shared(name, "ERROR", "ERROR")},
        {name + ": activate of a component in ERROR is refused", rtm("activate"),
         shared(name, "ERROR", "ERROR")},
        {name + ": it is recovered, its RTC becomes INACTIVE", then(fails("no"), opros("recover")),
         shared(name, "READY", "INACTIVE")},
        {name + ": start after recover", opros("start"), shared(name, "ACTIVE", "ACTIVE")},
        {name + ": stopOnError again", opros("fail"), shared(name, "ERROR", "ERROR")},
        {name + ": it is reset, its RTC becomes ACTIVE", opros("reset"), shared(name, "ACTIVE", "ACTIVE")},
        {name + ": stop before a start that fails", then(opros("stop"), fails("start")),
         shared(name, "INACTIVE", "INACTIVE")},
        {name + ": activate, onStart fails, both are in ERROR", rtm("activate"),
         shared(name, "ERROR", "ERROR")},
        {name + ": reset after that", then(fails("no"), rtm("reset")), shared(name, "READY", "INACTIVE")},
        {name + ": start before a stop that fails", then(rtm("activate"), fails("stop")),
         shared(name, "ACTIVE", "ACTIVE")},
        {name + ": deactivate, onStop fails, both are in ERROR", rtm("deactivate"),
         shared(name, "ERROR", "ERROR")},
        {name + ": reset of the RTC", then(fails("no"), rtm("reset")), shared(name, "READY", "INACTIVE")},
        {name + ": activate before a recovery that fails", then(rtm("activate"), fails("recover")),
         shared(name, "ACTIVE", "ACTIVE")},
        {name + ": stopOnError", opros("fail"), shared(name, "ERROR", "ERROR")},
        {name + ": reset, onRecover fails, both stay in ERROR", rtm("reset"), shared(name, "ERROR", "ERROR")},
        {name + ": reset by OPRoS after that", then(fails("no"), opros("reset")),
         shared(name, "ACTIVE", "ACTIVE")},
    };
}

std::vector<Arrow> arrows_of_hosts(LifeCycleHosts& hosts) {
    const auto& all = adaptor("ACTIVE", "ACTIVE", "ACTIVE");
    auto everything = all;
    everything.opros.insert({{"Motor", "ACTIVE"}, {"Pump", "ACTIVE"}});
    everything.rtm.insert({{"Motor", "ACTIVE"}, {"Pump", "ACTIVE"}});
    const LifeCycleHosts::Expected no_opros{
        {}, {{"ServoRtc0", "INACTIVE"}, {"ServoRtc1", "INACTIVE"}, {"Motor", "ERROR"}, {"Pump", "ERROR"}}};
    const LifeCycleHosts::Expected no_rtm{{{"Adaptor", "ACTIVE"}, {"Motor", "ACTIVE"}, {"Pump", "ACTIVE"}},
                                          {}};
    return {
        {"the OPRoS host dies", [&] { hosts.kill("opros"); }, no_opros},
        {"the OPRoS host comes back", [&] { hosts.start_opros(); }, everything},
        {"the OPRoS host ends", [&] { hosts.stop("opros"); }, no_opros},
        {"the OPRoS host is started again", [&] { hosts.start_opros(); }, everything},
        {"the RTM host dies", [&] { hosts.kill("rtm"); }, no_rtm},
        {"the RTM host comes back", [&] { hosts.start_rtm(); }, everything},
        {"the RTM host ends", [&] { hosts.stop("rtm"); }, no_rtm},
        {"the RTM host is started again", [&] { hosts.start_rtm(); }, everything},
        {"Motor is started through its RTC and the RTM host dies: Motor is stopped",
         [&] {
             hosts.rtm({"deactivate", "Motor"});
             hosts.rtm({"activate", "Motor"});
             hosts.kill("rtm");
         },
         {{{"Adaptor", "ACTIVE"}, {"Motor", "INACTIVE"}, {"Pump", "ACTIVE"}}, {}}},
        {"the RTM host comes back, and has Motor as it is",
         [&] { hosts.start_rtm(); },
         {{{"Motor", "INACTIVE"}}, {{"Motor", "INACTIVE"}, {"Pump", "ACTIVE"}, {"ServoRtc0", "ACTIVE"}}}},
    };
}

/// At the end, since they leave nothing to go on with.
std::vector<Arrow> arrows_to_the_end(LifeCycleHosts& hosts) {
    return {
        {"exit of its RTC destroys Motor",
         [&] {
             hosts.rtm({"exit", "Motor"});
         },
         {{{"Motor", "DESTROYED"}, {"Pump", "ACTIVE"}, {"Adaptor", "ACTIVE"}},
          {{"Motor", "gone"}, {"Pump", "ACTIVE"}}}},
        {"Pump is destroyed by OPRoS: its RTC goes to ERROR",
         [&] { hosts.opros("destroy", "Pump"); },
         {{{"Pump", "DESTROYED"}}, {{"Pump", "ERROR"}}}},
        {"exit of an RTC behind the link: AdaptorComp goes to ERROR",
         [&] {
             hosts.rtm({"exit", "ServoRtc1"});
         },
         {{{"Adaptor", "ERROR"}}, {{"ServoRtc1", "gone"}, {"ServoRtc0", "ACTIVE"}}}},
        {"AdaptorComp is destroyed: the RTCs that it has activated become INACTIVE",
         [&] { hosts.opros("destroy", "Adaptor"); },
         {{{"Adaptor", "DESTROYED"}}, {{"ServoRtc0", "INACTIVE"}}}},
    };
}

} // namespace

TEST_CASE("every transition of one side is that of the drawing on the other side") {
    LifeCycleHosts hosts;
    hosts.start_both();
    Walk walk(hosts);
    const std::string at_first =
        hosts.differs({{{"Adaptor", "ACTIVE"}, {"Motor", "ACTIVE"}, {"Pump", "ACTIVE"}},
                       {{"Motor", "ACTIVE"}, {"Pump", "ACTIVE"}}});
    REQUIRE(at_first == "");
    walk.follow(arrows_of_adaptor(hosts));
    walk.follow(arrows_of_shared(hosts, "Motor"));
    walk.follow(arrows_of_shared(hosts, "Pump"));
    walk.follow(arrows_of_hosts(hosts));
    walk.follow(arrows_to_the_end(hosts));
    std::cout << "life-cycle cells: " << walk.cells() << ", " << walk.failed() << " failed\n";
    CHECK(hosts.stop_both());
    CHECK_FALSE(hosts.left_in_shared_memory());
}
