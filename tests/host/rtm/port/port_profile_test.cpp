// SPDX-License-Identifier: Apache-2.0
// The profile of a port, which connections and tools read while the component describes the port.
#include "tests/host/rtm/manager_fixture.hpp"
#include <rtm/CORBA_RTCUtil.h>
#include <thread>

using namespace testing;

namespace {

/// A port with properties of its component.
class DescribedPort : public RTC::InPort<RTC::TimedLong> {
  public:
    using InPort::InPort;
    void describe(int number) { addProperty(("note." + std::to_string(number)).c_str(), number); }
};

} // namespace

TEST_CASE("A component describes a port while others connect it") {
    ManagerFixture fixture;
    auto& accumulator = fixture.create<Accumulator>("Accumulator");
    fixture.create<Counter>("Counter");
    RTC::TimedLong value{};
    DescribedPort described("described", value);
    REQUIRE(accumulator.addInPort("described", described));
    constexpr int notes = 2000;
    std::jthread component([&] {
        for (int number = 0; number < notes; ++number) described.describe(number);
    });
    for (int i = 0; i < 20; ++i) {
        fixture.connect("Counter0.out?port=Accumulator0.described");
        CHECK(described.disconnect_all() == RTC::RTC_OK);
    }
    component.join();
    const RTC::PortProfile profile = described.profileWithoutConnections();
    CHECK(NVUtil::find_index(profile.properties, ("note." + std::to_string(notes - 1)).c_str()) >= 0);
    CHECK(std::string(profile.name) == "Accumulator0.described");
    RTC::RTObject_var owner = accumulator.getObjRef();
    CHECK(owner->_is_equivalent(profile.owner));
    accumulator.removeInPort(described);
}
