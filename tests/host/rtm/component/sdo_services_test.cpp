// SPDX-License-Identifier: Apache-2.0
// SDO services: providers, which tools call, and consumers of services of tools.
#include "tests/host/rtm/manager_fixture.hpp"
#include <rtm/SdoServiceConsumerBase.h>
#include <rtm/SdoServiceProviderBase.h>

using namespace testing;

namespace {

int finalized = 0;

/// A provider without operations; counts its finalize().
struct Offered : RTC::SdoServiceProviderBase {
    bool init(RTC::RTObject_impl&, const SDOPackage::ServiceProfile& profile) override {
        return reinit(profile);
    }
    bool reinit(const SDOPackage::ServiceProfile& profile) override {
        profile_ = profile;
        return true;
    }
    const SDOPackage::ServiceProfile& getProfile() const override { return profile_; }
    void finalize() override { ++finalized; }
    SDOPackage::ServiceProfile profile_;
};

/// A consumer that records its calls.
struct Used : RTC::SdoServiceConsumerBase {
    static std::vector<std::string>& calls() {
        static std::vector<std::string> all;
        return all;
    }
    bool init(RTC::RTObject_impl& rtobj, const SDOPackage::ServiceProfile& profile) override {
        calls().push_back(std::string("init ") + rtobj.getInstanceName());
        profile_ = profile;
        return true;
    }
    bool reinit(const SDOPackage::ServiceProfile&) override {
        calls().push_back("reinit");
        return true;
    }
    const SDOPackage::ServiceProfile& getProfile() const override { return profile_; }
    void finalize() override { calls().push_back("finalize"); }
    SDOPackage::ServiceProfile profile_;
};

SDOPackage::ServiceProfile profile_of(const char* id, const char* type) {
    SDOPackage::ServiceProfile profile;
    profile.id = CORBA::string_dup(id);
    profile.interface_type = CORBA::string_dup(type);
    return profile;
}

} // namespace

TEST_CASE("A component offers the SDO services whose providers a library has registered") {
    RTC::SdoServiceProviderFactory::instance().addFactory(
        "IDL:test/Offered:1.0", coil::Creator<RTC::SdoServiceProviderBase, Offered>,
        coil::Destructor<RTC::SdoServiceProviderBase, Offered>);
    {
        ManagerFixture fixture;
        RTC::RTObject_var rtc = fixture.create<Counter>("Counter").getObjRef();
        SDOPackage::ServiceProfileList_var profiles = rtc->get_service_profiles();
        REQUIRE(profiles->length() == 1);
        CHECK(std::string(profiles[0].id) == "IDL:test/Offered:1.0");
        SDOPackage::SDOService_var service = rtc->get_sdo_service("IDL:test/Offered:1.0");
        CHECK_FALSE(CORBA::is_nil(service.in()));
        CHECK_THROWS_AS(rtc->get_sdo_service("another"), SDOPackage::InvalidParameter);
        CHECK(finalized == 0);
    }
    CHECK(finalized == 1);
}

TEST_CASE("A component adds and removes its own SDO services") {
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    CHECK(counter.addSdoServiceProvider(profile_of("mine", "IDL:test/Offered:1.0"), new Offered));
    SDOPackage::ServiceProfile_var found = counter.get_service_profile("mine");
    CHECK(std::string(found->interface_type) == "IDL:test/Offered:1.0");
    CHECK(counter.removeSdoServiceProvider("mine"));
    CHECK(finalized == 1);
    CHECK_FALSE(counter.removeSdoServiceProvider("mine"));
    CHECK_FALSE(counter.addSdoServiceConsumer(profile_of("a", "IDL:test/Unknown:1.0")));
}

TEST_CASE("A component uses the SDO services that a tool adds until the tool removes them") {
    RTC::SdoServiceConsumerFactory::instance().addFactory(
        "IDL:test/Used:1.0", coil::Creator<RTC::SdoServiceConsumerBase, Used>,
        coil::Destructor<RTC::SdoServiceConsumerBase, Used>);
    ManagerFixture fixture;
    RTC::RTObject_var rtc = fixture.create<Counter>("Counter").getObjRef();
    SDOPackage::Configuration_var configuration = rtc->get_configuration();
    CHECK_FALSE(configuration->add_service_profile(profile_of("a", "IDL:test/Unknown:1.0")));
    CHECK(configuration->add_service_profile(profile_of("a", "IDL:test/Used:1.0")));
    CHECK(configuration->add_service_profile(profile_of("a", "IDL:test/Used:1.0")));
    CHECK(configuration->remove_service_profile("a"));
    CHECK_FALSE(configuration->remove_service_profile("a"));
    CHECK(Used::calls() == std::vector<std::string>{"init Counter0", "reinit", "finalize"});
}
