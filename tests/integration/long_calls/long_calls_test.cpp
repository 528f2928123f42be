// SPDX-License-Identifier: Apache-2.0
// Service calls that take long, both ways: progress, cancellation, and the death of a host.
#include "tests/integration/two_hosts.hpp"

#include <catch2/catch.hpp>
#include <fcntl.h>

#include <sys/stat.h>

namespace {

/// An operator in one host, a crane in the other one.
struct CraneHosts : TwoHosts {
    explicit CraneHosts(bool from_opros)
        : caller(from_opros ? "opros" : "rtm"), provider(from_opros ? "rtm" : "opros") {
        set_talker("");
        REQUIRE(mkfifo(pipe().c_str(), 0600) == 0);
        // Kept open, for reading, too: what is written stays there until the operator reads it.
        pipe_ = tandem::process::FileDescriptor(open(pipe().c_str(), O_RDWR | O_CLOEXEC));
        if (from_opros) {
            set_rtc("CraneRtc");
            add_component("Operator", "OperatorComp", property("pipe", pipe()));
            set_connections(connection("service", "Operator", "crane", "Adaptor", "crane"));
        } else {
            set_rtc("OperatorRtc");
            set_rtc_properties("conf.default.pipe=" + pipe());
            add_component("Crane", "CraneComp");
            set_connections(connection("service", "Adaptor", "crane", "Crane", "crane"));
        }
        start_opros();
        start_rtm();
    }
    std::string pipe() const { return (folder() / "pipe").string(); }
    void command(const std::string& line) const {
        const std::string whole = line + "\n";
        REQUIRE(write(pipe_.get(), whole.data(), whole.size()) == static_cast<ssize_t>(whole.size()));
    }
    /// Returns whether the call ends as expected, at the caller.
    bool ends(const std::string& text) const { return says(caller, "operator: " + text + "\n"); }
    /// Returns whether the call of `lift` ends with an exception.
    bool fails() const { return says(caller, "operator: lift IDL:omg.org/CORBA/"); }
    bool crane_says(const std::string& text) const { return says(provider, "crane: " + text + "\n"); }

    const std::string caller, provider;

  private:
    tandem::process::FileDescriptor pipe_;
};

constexpr const char* cancelled = "lift IDL:omg.org/CORBA/NO_RESPONSE:1.0";
constexpr int endless = 100'000;

} // namespace

TEST_CASE("a call that takes longer than call_timeout shows its progress and returns its result") {
    CraneHosts hosts(GENERATE(true, false));
    hosts.command("lift 200"); // 2 s at least
    hosts.command("watch");
    CHECK(hosts.ends("progress rises"));
    CHECK(hosts.ends("lift 200"));
    // A call that has ended cannot be cancelled, and the next call with another handle is not cancelled.
    hosts.command("cancel");
    hosts.command("lift 2");
    CHECK(hosts.ends("lift 2"));
    CHECK(hosts.stop_both());
}

TEST_CASE("a cancelled call ends at the caller, and its provider stops") {
    CraneHosts hosts(GENERATE(true, false));
    hosts.command("lift " + std::to_string(endless));
    hosts.command("watch");
    CHECK(hosts.ends("progress rises"));
    hosts.command("cancel");
    CHECK(hosts.ends(cancelled));
    CHECK(hosts.crane_says("lift stopped"));
    hosts.command("lift 3");
    CHECK(hosts.ends("lift 3"));
    CHECK(hosts.stop_both());
}

TEST_CASE("a provider stops when the deadline of its caller has passed") {
    CraneHosts hosts(GENERATE(true, false));
    hosts.command("plain " + std::to_string(endless));
    CHECK(hosts.ends("plain IDL:omg.org/CORBA/TIMEOUT:1.0"));
    CHECK(hosts.crane_says("lift stopped"));
    CHECK(hosts.stop_both());
}

TEST_CASE("calls without a waiting caller stay pending until they end or are cancelled") {
    CraneHosts hosts(GENERATE(true, false));
    hosts.command("lower 2");
    CHECK(hosts.ends("lower pending"));
    hosts.command("wait");
    CHECK(hosts.ends("nothing pending"));
    CHECK(hosts.crane_says("lower done"));
    hosts.command("lower " + std::to_string(endless));
    hosts.command("watch");
    CHECK(hosts.ends("progress rises"));
    hosts.command("cancel");
    hosts.command("wait");
    CHECK(hosts.crane_says("lower stopped"));
    hosts.command("lift 3");
    CHECK(hosts.ends("lift 3"));
    CHECK(hosts.output(hosts.caller).find("still pending") == std::string::npos);
    CHECK(hosts.stop_both());
}

TEST_CASE("a provider stops when the host of its caller dies") {
    CraneHosts hosts(GENERATE(true, false));
    hosts.command("lift " + std::to_string(endless));
    CHECK(hosts.crane_says("lift begins"));
    hosts.kill(hosts.caller);
    CHECK(hosts.crane_says("lift stopped"));
    CHECK(hosts.stop(hosts.provider) == 0);
}

TEST_CASE("a call ends when the host of its provider dies, and can still be cancelled") {
    const bool from_opros = GENERATE(true, false);
    CraneHosts hosts(from_opros);
    hosts.command("lift " + std::to_string(endless));
    CHECK(hosts.crane_says("lift begins"));
    hosts.kill(hosts.provider);
    CHECK(hosts.fails());
    if (from_opros) { // an RTC is deactivated, and ends its calls itself
        CHECK(hosts.ends("lift IDL:omg.org/CORBA/COMM_FAILURE:1.0"));
        hosts.command("cancel");
        hosts.command("wait");
        CHECK(hosts.ends("nothing pending"));
    }
    CHECK(hosts.stop(hosts.caller) == 0);
}

TEST_CASE("a stopping host does not wait for a call that checks for cancellation") {
    CraneHosts hosts(GENERATE(true, false));
    hosts.command("lift " + std::to_string(endless));
    CHECK(hosts.crane_says("lift begins"));
    CHECK(hosts.stop(hosts.provider) == 0);
    CHECK(hosts.crane_says("lift stopped"));
    CHECK(hosts.fails());
    CHECK(hosts.stop(hosts.caller) == 0);
}
