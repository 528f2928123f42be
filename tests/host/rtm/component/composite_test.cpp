// SPDX-License-Identifier: Apache-2.0
// PeriodicECSharedComposite: components that share the execution context of a composite.
#include "tests/host/rtm/manager_fixture.hpp"

using namespace testing;

namespace {

RTC::RTObject_impl& composite(ManagerFixture& fixture, const std::string& arguments) {
    return fixture.manager().createOrThrow("PeriodicECSharedComposite?" + arguments);
}

std::vector<std::string> port_names(RTC::RTObject_impl& rtc) {
    RTC::ComponentProfile_var profile = rtc.get_component_profile();
    std::vector<std::string> names;
    for (CORBA::ULong i = 0; i < profile->port_profiles.length(); ++i)
        names.emplace_back(profile->port_profiles[i].name);
    return names;
}

SDOPackage::Organization_ptr organization_of(RTC::RTObject_impl& rtc) {
    SDOPackage::OrganizationList_var all = rtc.get_owned_organizations();
    REQUIRE(all->length() == 1);
    return SDOPackage::Organization::_duplicate(all[0]);
}

RTC::LifeCycleState state_in(RTC::RTObject_impl& owner, RTC::RTObject_impl& member) {
    RTC::ExecutionContext_var context = owner.get_context(0);
    return context->get_component_state(RTC::RTObject_var(member.getObjRef()).in());
}

} // namespace

TEST_CASE(
    "Members of a composite run in its context one after the other and their exported ports are its own") {
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    auto& accumulator = fixture.create<Accumulator>("Accumulator");
    fixture.connect("Counter0.out?port=Accumulator0.in");
    auto& whole = composite(fixture, "members=Counter0, Accumulator0&exported_ports=Counter0.out");
    CHECK(port_names(whole) == std::vector<std::string>{"Counter0.out"});

    RTC::ExecutionContext_var own = counter.get_context(0);
    CHECK_FALSE(own->is_running());
    RTC::ExecutionContextList_var others = counter.get_participating_contexts();
    CHECK(others->length() == 1);

    REQUIRE(fixture.activate(whole) == RTC::RTC_OK);
    for (int i = 0; i < 11; ++i) fixture.step(whole); // the members become active in the first step
    CHECK(counter.value_.data == 11);
    CHECK(accumulator.received_ == 11);
    REQUIRE(whole.deactivate(0) == RTC::RTC_OK);
    fixture.step(whole);
    CHECK(state_in(whole, counter) == RTC::INACTIVE_STATE);
    CHECK(counter.value_.data == 11);
}

TEST_CASE("Members come and go through the organization of the composite") {
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    auto& whole = composite(fixture, "exported_ports=Counter0.out");
    SDOPackage::Organization_var organization = organization_of(whole);
    CHECK(port_names(whole).empty());

    SDOPackage::SDOList members;
    members.length(1);
    members[0] = counter.getObjRef();
    CHECK(organization->add_members(members));
    CHECK(port_names(whole) == std::vector<std::string>{"Counter0.out"});
    SDOPackage::OrganizationList_var of_member = counter.get_organizations();
    REQUIRE(of_member->length() == 1);
    CHECK(of_member[0]->_is_equivalent(organization.in()));
    SDOPackage::SDOSystemElement_var owner = organization->get_owner();
    CHECK(owner->_is_equivalent(RTC::RTObject_var(whole.getObjRef()).in()));

    fixture.activate(whole);
    fixture.step(whole);
    CHECK(counter.value_.data == 1);
    CHECK(organization->remove_member("Counter0"));
    CHECK(port_names(whole).empty());
    SDOPackage::SDOList_var left = organization->get_members();
    CHECK(left->length() == 0);
    RTC::ExecutionContext_var own = counter.get_context(0);
    CHECK(own->is_running());
    CHECK_THROWS_AS(organization->remove_member("Counter0"), SDOPackage::InvalidParameter);
    REQUIRE(fixture.activate(counter) == RTC::RTC_OK);
    fixture.step(counter);
    CHECK(counter.value_.data == 2);
    counter.deactivate(0);
    CHECK(organization->set_members(members));
    CHECK(organization->set_members(SDOPackage::SDOList()));
    CHECK(own->is_running());
}

TEST_CASE("A member that exits leaves its composite, and a composite that exits releases its members") {
    ManagerFixture fixture;
    auto& first = fixture.create<Counter>("Counter");
    auto& second = fixture.create<Counter>("Counter");
    auto& whole = composite(fixture, "members=Counter0, Counter1");
    fixture.activate(whole);
    fixture.step(whole);
    CHECK(first.exit() == RTC::RTC_OK);
    SDOPackage::Organization_var organization = organization_of(whole);
    SDOPackage::SDOList_var left = organization->get_members();
    CHECK(left->length() == 1);
    fixture.step(whole);
    CHECK(second.value_.data == 2);
    CHECK(whole.exit() == RTC::RTC_OK);
    fixture.manager().cleanupComponents();
    CHECK(fixture.activate(second) == RTC::RTC_OK);
    fixture.step(second);
    CHECK(second.value_.data == 3);
}

TEST_CASE("The exported ports follow the configuration") {
    ManagerFixture fixture;
    fixture.create<Counter>("Counter");
    fixture.create<Accumulator>("Accumulator");
    auto& whole = composite(fixture, "members=Counter0, Accumulator0&exported_ports=Counter0.out");
    SDOPackage::Configuration_var configuration = whole.get_configuration();
    SDOPackage::ConfigurationSet_var set = configuration->get_configuration_set("default");
    coil::Properties change;
    change.setProperty("exported_ports", "Accumulator0.in");
    NVUtil::copyFromProperties(set->configuration_data, change);
    CHECK(configuration->set_configuration_set_values(set.in()));
    CHECK(port_names(whole) == std::vector<std::string>{"Accumulator0.in"});
}

TEST_CASE("The members of a composite within a composite become active, run and stop with the outer one") {
    ManagerFixture fixture;
    auto& first = fixture.create<Counter>("Counter");
    auto& second = fixture.create<Counter>("Counter");
    auto& innermost =
        composite(fixture, "instance_name=innermost&members=Counter0&exported_ports=Counter0.out");
    composite(fixture, "instance_name=inner&members=innermost");
    auto& outer = composite(
        fixture, "instance_name=outer&members=inner, Counter1&exported_ports=Counter0.out, Counter1.out");
    CHECK(port_names(outer) == std::vector<std::string>{"Counter1.out"}); // inner does not show Counter0.out
    REQUIRE(fixture.activate(outer) == RTC::RTC_OK);
    for (int i = 0; i < 5; ++i) fixture.step(outer);
    CHECK(state_in(outer, first) == RTC::ACTIVE_STATE);
    CHECK(state_in(outer, innermost) == RTC::ACTIVE_STATE);
    CHECK(first.value_.data == 5);
    CHECK(second.value_.data == 5);
    fixture.step(innermost); // its own context is stopped, so no component runs twice
    CHECK(first.value_.data == 5);
    REQUIRE(outer.deactivate(0) == RTC::RTC_OK);
    fixture.step(outer);
    CHECK(state_in(outer, first) == RTC::INACTIVE_STATE);
    CHECK(state_in(outer, innermost) == RTC::INACTIVE_STATE);
    CHECK(first.value_.data == 5);
}

TEST_CASE("An error of a member of an inner composite is reset with the outer one") {
    ManagerFixture fixture;
    auto& recorder = fixture.create<Recorder>("Recorder");
    composite(fixture, "instance_name=inner&members=Recorder0");
    auto& outer = composite(fixture, "instance_name=outer&members=inner");
    REQUIRE(fixture.activate(outer) == RTC::RTC_OK);
    Recorder::failing_callback() = "execute";
    for (int i = 0; i < 3; ++i) fixture.step(outer);
    CHECK(state_in(outer, recorder) == RTC::ERROR_STATE);
    Recorder::failing_callback() = "";
    CHECK(outer.on_reset(0) == RTC::RTC_OK); // the outer one itself has no error
    fixture.step(outer);
    CHECK(state_in(outer, recorder) == RTC::INACTIVE_STATE);
}

TEST_CASE("Members that join or leave an inner composite join or leave the outer one's context") {
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    auto& inner = composite(fixture, "instance_name=inner");
    auto& outer = composite(fixture, "instance_name=outer&members=inner");
    SDOPackage::SDOList members;
    members.length(1);
    members[0] = counter.getObjRef();
    SDOPackage::Organization_var organization = organization_of(inner);
    CHECK(organization->add_members(members));
    CHECK_FALSE(organization->add_members(members)); // once
    REQUIRE(fixture.activate(outer) == RTC::RTC_OK);
    for (int i = 0; i < 3; ++i) fixture.step(outer);
    CHECK(counter.value_.data == 3);

    CHECK(organization->remove_member("Counter0"));
    fixture.step(outer);
    CHECK(counter.value_.data == 3);
    RTC::ExecutionContextList_var others = counter.get_participating_contexts();
    CHECK(others->length() == 0);
    REQUIRE(fixture.activate(counter) == RTC::RTC_OK);
    fixture.step(counter);
    CHECK(counter.value_.data == 4);
}

TEST_CASE("A composite that ends gives the members of its inner composite back to that one") {
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    auto& inner = composite(fixture, "instance_name=inner&members=Counter0");
    auto& outer = composite(fixture, "instance_name=outer&members=inner");
    REQUIRE(fixture.activate(outer) == RTC::RTC_OK);
    fixture.step(outer);
    CHECK(outer.exit() == RTC::RTC_OK);
    fixture.manager().cleanupComponents();
    REQUIRE(fixture.activate(inner) == RTC::RTC_OK);
    const auto before = counter.value_.data;
    for (int i = 0; i < 3; ++i) fixture.step(inner);
    CHECK(counter.value_.data == before + 3);
}

TEST_CASE("A composite does not become a member of itself or of one of its members") {
    ManagerFixture fixture;
    auto& inner = composite(fixture, "instance_name=inner");
    auto& outer = composite(fixture, "instance_name=outer&members=inner");
    SDOPackage::SDOList members;
    members.length(1);
    members[0] = outer.getObjRef();
    CHECK_FALSE(SDOPackage::Organization_var(organization_of(outer))->add_members(members));
    CHECK_FALSE(SDOPackage::Organization_var(organization_of(inner))->add_members(members));
    CHECK(fixture.activate(outer) == RTC::RTC_OK);
}
