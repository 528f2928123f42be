// SPDX-License-Identifier: Apache-2.0
// RTCs behind a link, in a process that knows nothing about the link.
#include "tests/apps/tandem/program.hpp"
#include "tests/integration/two_hosts.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <fcntl.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include <sstream>

using namespace std::chrono_literals;

namespace {

/// A host with EchoRtc0 and ServoRtc0 that has no InterceptorComp, beside the two of a link.
class ForeignHost : public TwoHosts {
  public:
    ForeignHost() : port_(unused_port()) {
        set_rtc("ServoRtc"); // of the same name as the foreign one, and not shared
        set_strict(false);   // connections wait for their ports
        share("EchoRtc0");
    }
    std::string address(const std::string& rtc) const { return "rtcloc://127.0.0.1:" + port_ + "/" + rtc; }
    void share(const std::string& rtc) { set_interceptor("rtc=" + address(rtc)); }
    void start_foreign(const std::string& more = "") {
        start_another_rtm(port_,
                          "exec_cxt.periodic.rate: 100\n"
                          "manager.modules.preload: AlarmRtc.so, EchoRtc.so, ServoRtc.so, StampRtc.so\n"
                          "manager.components.precreate: AlarmRtc, EchoRtc, ServoRtc, StampRtc\n" +
                              more);
        REQUIRE(becomes("StampRtc0", "INACTIVE")); // the last that is created
    }
    void start_all() {
        start_foreign();
        start_rtm();
        start_opros();
    }
    tandem::test::Result foreign(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "rtm");
        arguments.insert(arguments.end(), {"--manager", "127.0.0.1:" + port_});
        return tandem::test::tandem_program(arguments);
    }
    std::string state(const std::string& rtc) const {
        const auto list = foreign({"list", "--json"});
        if (list.exit_code != 0) return list.errors;
        for (const auto& entry : list.json())
            if (entry["instance"] == rtc) return entry["state"];
        return "gone";
    }
    bool becomes(const std::string& rtc, const std::string& wanted) const {
        std::string is;
        for (int i = 0; i < 300; ++i) {
            if ((is = state(rtc)) == wanted) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
        UNSCOPED_INFO(rtc << " is " << is);
        return false;
    }
    /// Ends OPRoS' host, whose end deactivates EchoRtc0, and then the others. True if all did so in order.
    bool ends() {
        const bool deactivated = stop("opros") == 0 && becomes("EchoRtc0", "INACTIVE");
        return deactivated && stop("rtm") == 0 && stop("other") == 0;
    }
    /// Returns a line that the host has not printed before.
    bool says_now(const std::string& host, const std::string& text) { return says(host, text, seen_[host]); }
    void forget() {
        for (const char* host : {"opros", "rtm"}) seen_[host] = output(host).size();
    }
    /// The numbers of the words that have come back, in their order.
    std::vector<int> replies() const {
        std::vector<int> numbers;
        const std::string begin = "reply: hello ";
        std::string line;
        for (std::istringstream lines(output("opros")); std::getline(lines, line);)
            if (line.starts_with(begin)) numbers.push_back(std::stoi(line.substr(begin.size())));
        return numbers;
    }

  private:
    const std::string port_;
    std::map<std::string, std::size_t> seen_;
};

/// omniNames at a port of 127.0.0.1, without the names of an earlier one.
class NameServer {
  public:
    NameServer(const std::filesystem::path& folder, const std::string& port)
        : log_(open((folder / "names.log").c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600)),
          server_({"omniNames", "-start", port, "-ignoreport", "-logdir", folder.string(), "-ORBendPoint",
                   "giop:tcp:127.0.0.1:" + port},
                  {-1, log_.get(), log_.get(), ""}) {}
    ~NameServer() { server_.stop(5s); }

  private:
    tandem::process::FileDescriptor log_;
    tandem::process::ChildProcess server_;
};

bool rises(const std::vector<int>& numbers) {
    return std::adjacent_find(numbers.begin(), numbers.end(), std::greater_equal<>()) == numbers.end();
}

/// A ForeignHost with ServoRtc0 across the link. TransitionComp, which makes transitions of Adaptor, replaces
/// TalkerComp.
class ForeignServo : public ForeignHost {
  public:
    ForeignServo() {
        std::filesystem::copy_file(TEST_SOURCES "/life_cycle/TransitionComp.xml",
                                   folder() / "TransitionComp.xml");
        set_talker("TransitionComp");
        set_talker_properties(property("commands", (folder() / "commands").string()));
        std::ofstream(folder() / "commands");
        set_connections("");
        share("ServoRtc0");
    }
    /// Returns what TransitionComp says, `Adaptor is ACTIVE`.
    std::string conduct(const std::string& verb) {
        const std::string number = std::to_string(++commands_);
        std::ofstream(folder() / "commands", std::ios::app) << number << " " << verb << " Adaptor\n";
        const std::string answer = "transition " + number + ": ";
        if (!says("opros", answer)) return "no answer";
        const std::string all = output("opros");
        const auto begin = all.find(answer) + answer.size();
        return all.substr(begin, all.find('\n', begin) - begin);
    }
    bool adaptor_becomes(const std::string& state) {
        for (int i = 0; i < 300; ++i) {
            if (conduct("state") == "Adaptor is " + state) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
        return false;
    }

  private:
    int commands_ = 0;
};

} // namespace

TEST_CASE("data and calls cross to and from an RTC of a process that does not know the link") {
    ForeignHost hosts;
    hosts.start_all();
    CHECK(hosts.says("opros", "pages: 2 last 5"));
    CHECK(hosts.says("opros", "TestDictionary/NotFound"));
    for (int i = 0; i < 1500 && hosts.replies().size() < 100; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    CHECK(hosts.replies().size() >= 100);
    CHECK(rises(hosts.replies()));
    CHECK(hosts.ends());
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE("a foreign process that is killed and returns is noticed, connected and activated again") {
    ForeignHost hosts;
    hosts.start_all();
    REQUIRE(hosts.says("opros", "reply: hello"));
    for (int round = 0; round < 2; ++round) {
        hosts.forget();
        hosts.kill("other");
        CHECK(hosts.says_now("rtm",
                             "EchoRtc0 has gone with its process; the search continues until it is back"));
        CHECK(hosts.says_now("opros", "port Adaptor.reply was removed: 1 of its connections end"));
        hosts.forget();
        hosts.start_foreign();
        CHECK(hosts.says_now("opros", "reply: hello"));
        CHECK(hosts.says_now("opros", "pages: 2 last 5"));
        CHECK(hosts.becomes("EchoRtc0", "ACTIVE"));
    }
    CHECK(rises(hosts.replies()));
    CHECK(hosts.ends());
}

TEST_CASE("a missing foreign RTC is reported once, and shared when it appears") {
    ForeignHost hosts;
    hosts.start_rtm();
    hosts.start_opros();
    const std::string nobody = "no process listens there";
    REQUIRE(hosts.says("rtm", nobody));
    CHECK(hosts.says("opros", "component 'Adaptor' has no port 'word'"));
    std::this_thread::sleep_for(std::chrono::seconds(2)); // several looks
    const auto said = hosts.output("rtm");
    CHECK(said.find(nobody) == said.rfind(nobody));
    hosts.start_foreign();
    CHECK(hosts.says("opros", "reply: hello"));
    CHECK(hosts.becomes("EchoRtc0", "ACTIVE"));
    CHECK(hosts.ends());
}

TEST_CASE("with strict, a missing foreign RTC prevents the creation of InterceptorComp") {
    ForeignHost hosts;
    hosts.start_foreign();
    hosts.set_interceptor("rtc=" + hosts.address("NoSuchRtc0") + "&strict=1");
    hosts.start_rtm();
    CHECK(hosts.exit_code("rtm") == 1);
    CHECK(hosts.says("rtm", hosts.address("NoSuchRtc0") + ": the manager there has no such component"));
}

TEST_CASE("the life cycle of AdaptorComp and that of a foreign RTC follow each other") {
    ForeignServo hosts;
    hosts.start_all();
    REQUIRE(hosts.adaptor_becomes("ACTIVE"));
    CHECK(hosts.state("ServoRtc0") == "ACTIVE");
    CHECK(hosts.conduct("stop") == "Adaptor is INACTIVE");
    CHECK(hosts.state("ServoRtc0") == "INACTIVE");
    CHECK(hosts.conduct("start") == "Adaptor is ACTIVE");
    CHECK(hosts.state("ServoRtc0") == "ACTIVE");

    REQUIRE(hosts.foreign({"conf", "ServoRtc0", "fails=1"}).exit_code == 0);
    CHECK(hosts.says("opros", "RTC 'ServoRtc0' went to ERROR"));
    CHECK(hosts.adaptor_becomes("ERROR"));
    CHECK(hosts.state("ServoRtc0") == "ERROR");
    REQUIRE(hosts.foreign({"conf", "ServoRtc0", "fails=0"}).exit_code == 0);
    CHECK(hosts.conduct("recover") == "Adaptor is READY");
    CHECK(hosts.state("ServoRtc0") == "INACTIVE");
    CHECK(hosts.conduct("start") == "Adaptor is ACTIVE");
    CHECK(hosts.state("ServoRtc0") == "ACTIVE");

    // Neither end leaves an RTC running that the link has activated, and the host of the link activates it again.
    CHECK(hosts.stop("rtm") == 0);
    CHECK(hosts.becomes("ServoRtc0", "INACTIVE"));
    CHECK(hosts.conduct("state") == "Adaptor is ACTIVE");
    hosts.start_rtm();
    CHECK(hosts.becomes("ServoRtc0", "ACTIVE"));
    hosts.kill("opros");
    CHECK(hosts.becomes("ServoRtc0", "INACTIVE"));
    CHECK(hosts.stop("rtm") == 0);
}

TEST_CASE("a foreign RTC that did not answer a deactivation is deactivated when it answers") {
    ForeignServo hosts;
    hosts.start_all();
    REQUIRE(hosts.adaptor_becomes("ACTIVE"));
    hosts.pause("other");
    CHECK(hosts.says("rtm", "does not answer; its ports stay connected"));
    hosts.kill("opros");
    CHECK(hosts.says("rtm", "it is deactivated as soon as it does"));
    hosts.resume("other");
    CHECK(hosts.becomes("ServoRtc0", "INACTIVE"));
    CHECK(hosts.says("rtm", "is deactivated, as requested while it did not answer"));
    CHECK(hosts.stop("rtm") == 0);
}

TEST_CASE("a foreign RTC receives and sends each message in order, like one of the host") {
    const bool is_foreign = GENERATE(false, true);
    CAPTURE(is_foreign);
    ForeignHost hosts;
    hosts.set_talker("");
    hosts.add_component("Sender", "StampSendComp", TwoHosts::property("count", "300"));
    hosts.add_component("Taker", "StampTakeComp", TwoHosts::property("count", "0"));
    hosts.set_connections(TwoHosts::connection("data", "Sender", "there", "Adaptor", "there") +
                          TwoHosts::connection("data", "Adaptor", "back", "Taker", "back"));
    if (is_foreign) {
        hosts.share("StampRtc0");
        hosts.start_foreign();
    } else {
        hosts.set_rtc("StampRtc");
    }
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("opros", "back: 300 messages in order"));
    CHECK(hosts.says(is_foreign ? "other" : "rtm", "there: 300 messages in order"));
    // For docs/joining.md: `test_remote_rtc "*each message*" -s`. No limit is asserted.
    const auto line_of = [&](const std::string& host, const std::string& begin) {
        const std::string all = hosts.output(host);
        const auto at = all.find(begin);
        return at == std::string::npos ? "" : all.substr(at, all.find('\n', at) - at);
    };
    INFO(line_of(is_foreign ? "other" : "rtm", "there: ") << "; " << line_of("opros", "back: "));
    CHECK(hosts.stop("opros") == 0);
}

TEST_CASE("a port of an unknown type is left out, and crosses when a library provides the type") {
    const bool is_known = GENERATE(false, true);
    CAPTURE(is_known);
    ForeignHost hosts;
    hosts.set_talker("AlarmComp");
    hosts.set_adaptor_properties(TwoHosts::property("event_ports", "raised, answer"));
    hosts.set_connections(TwoHosts::connection("event", "Talker", "alarm", "Adaptor", "raised") +
                          TwoHosts::connection("event", "Adaptor", "answer", "Talker", "notice"));
    if (is_known) hosts.set_rtc("AlarmRtc");
    hosts.share("AlarmRtc0");
    hosts.start_foreign();
    hosts.start_rtm();
    hosts.start_opros();
    if (is_known)
        CHECK(hosts.says("opros", "event: answer to hot "));
    else
        CHECK(hosts.says("rtm",
                         "port 'raised' of AlarmRtc0: type IDL:TestAlarm/TimedAlarm:1.0 cannot cross the "
                         "link: its IDL is not known to the RTM host; build the RTC's IDL with it, or load "
                         "a library that has it; this port is left out, and the others work"));
    CHECK(hosts.stop("opros") == 0);
    CHECK(hosts.becomes("AlarmRtc0", "INACTIVE"));
    CHECK(hosts.stop("rtm") == 0);
}

TEST_CASE("a foreign RTC is found through a name server that starts late") {
    ForeignHost hosts;
    const std::string port = unused_port();
    hosts.set_interceptor("rtc=rtcname://127.0.0.1:" + port + "/EchoRtc0");
    hosts.start_rtm();
    hosts.start_opros();
    REQUIRE(hosts.says("rtm", "name server 127.0.0.1:" + port + ": no process listens there"));
    const NameServer server(hosts.folder(), port);
    CHECK(hosts.says("rtm", "EchoRtc0: name server 127.0.0.1:" + port + " has no such entry"));
    hosts.start_foreign(
        "naming.enable: YES\nnaming.formats: any.host_cxt/%n.rtc\ncorba.nameservers: 127.0.0.1:" + port +
        "\n");
    CHECK(hosts.says("opros", "reply: hello"));
    CHECK(hosts.ends());
}

TEST_CASE("a foreign process that stops for a while keeps its connections and blocks no other") {
    ForeignHost hosts;
    hosts.start_all();
    REQUIRE(hosts.says("opros", "reply: hello"));
    hosts.pause("other");
    CHECK(hosts.says("rtm", "EchoRtc0 does not answer; its ports stay connected"));
    const auto before = hosts.replies().size();
    hosts.forget();
    hosts.resume("other");
    CHECK(hosts.says("rtm", "EchoRtc0 answers again"));
    CHECK(hosts.says_now("opros", "reply: hello"));
    for (int i = 0; i < 1500 && hosts.replies().size() < before + 20; ++i) std::this_thread::sleep_for(20ms);
    CHECK(hosts.replies().size() >= before + 20);
    CHECK(rises(hosts.replies()));
    CHECK(hosts.output("rtm").find("was removed") == std::string::npos);
    CHECK(hosts.ends());
}
