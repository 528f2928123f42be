// SPDX-License-Identifier: Apache-2.0
// The RTCs that show OPRoS components, without a peer: the test itself shares and reports.
#include "proxy/interceptor/factory.hpp"
#include "proxy/interceptor/opros/opros_rtcs.hpp"
#include "tests/proxy/link/link_side.hpp"

#include "host/rtm/runtime/manager/manager_options.hpp"

using namespace tandem;
using namespace tandem::interceptor;
using link::test::eventually;

namespace {

RTC::Manager& start_manager() {
    coil::Argv arguments({"test", "-o", "logger.log_level:SILENT", "-o", "naming.enable:NO"});
    return RTC::Manager::start(static_cast<int>(arguments.size()), arguments.get(), {});
}

struct ShownComponents {
    ShownComponents() {
        register_factories(manager);
        LinkBuffer::register_factory();
        side.link.open();
    }
    ~ShownComponents() {
        side.link.close();
        rtcs.close();
        manager.shutdown();
    }

    /// A peer comes that shares the component Tally with an input port of that name.
    void peer_comes(const std::string& port) {
        link::PortTable table{{{"Tally"}}, {{link::PortKind::data_in, "Tally." + port, "T", "ad", "", {}}}};
        table.ports[0].component = "Tally";
        rtcs.set_peer_table(table, true);
    }
    void report(link::control::ComponentState state, std::uint64_t sequence) {
        const auto arguments = link::control::encode(link::control::StateReport{"Tally", state, sequence});
        rtcs.receive_state({"", link::control::state, "", arguments});
    }
    /// Returns whether an RTC with that port exists.
    bool is_shown(const std::string& port) {
        RTC::RTObject_impl* const rtc = manager.getComponent("Tally");
        if (rtc == nullptr) return false;
        RTC::PortServiceList_var ports = rtc->get_ports();
        for (CORBA::ULong i = 0; i < ports->length(); ++i) {
            RTC::PortProfile_var profile = ports[i]->get_port_profile();
            if (std::string(profile->name) == "Tally." + port) return true;
        }
        return false;
    }

    RTC::Manager& manager = start_manager();
    link::test::LinkSide side{shm::Side::second, {.name = link::test::unique_name("shown")}, {}};
    OprosRtcs rtcs{"Interceptor0", manager, side.link, "shown", std::chrono::milliseconds(100), [] {}};
};

} // namespace

TEST_CASE(
    "a component whose state arrives before the task for the new peer is shown in the state of this peer") {
    ShownComponents shown;
    shown.peer_comes("first");
    shown.side.link.post([&] { shown.rtcs.peer_connected(); });
    shown.report(link::control::ComponentState::inactive, 1);
    REQUIRE(eventually([&] { return shown.is_shown("first"); }));

    shown.peer_comes("second");
    shown.report(link::control::ComponentState::inactive, 1);
    shown.side.link.post([&] { shown.rtcs.peer_connected(); });
    CHECK(eventually([&] { return shown.is_shown("second"); }));
    CHECK_FALSE(shown.is_shown("first"));
}
