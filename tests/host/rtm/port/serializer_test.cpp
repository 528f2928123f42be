// SPDX-License-Identifier: Apache-2.0
// Serializers of users, which connections name by their marshaling type.
#include "tests/host/rtm/manager_fixture.hpp"

using namespace testing;

namespace {

// Whole numbers travel as numbers with a fraction.
struct LongAsDouble : RTC::CORBA_CdrSerializer<RTC::TimedLong> {
    bool serialize(const RTC::TimedLong& value) override {
        RTC::TimedDouble sent{};
        sent.tm = value.tm;
        sent.data = value.data;
        return m_cdr.serializeCDR(sent);
    }
};
struct DoubleFromLong : RTC::CORBA_CdrSerializer<RTC::TimedDouble> {
    bool deserialize(RTC::TimedDouble& value) override {
        RTC::TimedLong received{};
        const bool valid = m_cdr.deserializeCDR(received);
        value.tm = received.tm;
        value.data = received.data;
        return valid;
    }
};

struct LongToDoublePorts {
    RTC::TimedLong sent{};
    RTC::TimedDouble received{};
    RTC::OutPort<RTC::TimedLong> out{"a", sent};
    RTC::InPort<RTC::TimedDouble> in{"b", received};
    RTC::RTObject_impl& owner;
    explicit LongToDoublePorts(ManagerFixture& fixture, const std::string& configuration = "")
        : owner(fixture.create<Recorder>("Recorder?" + configuration)) {
        owner.addOutPort("a", out);
        owner.addInPort("b", in);
        RTC::addSerializer<RTC::TimedLong, LongAsDouble>("cdr:RTC/TimedDouble:RTC/TimedLong");
        RTC::addSerializer<RTC::TimedDouble, DoubleFromLong>("cdr:RTC/TimedLong:RTC/TimedDouble");
    }
    void check_values_arrive() {
        for (int i = -2; i < 3; ++i) {
            sent.data = i * 1000;
            REQUIRE(out.write());
            REQUIRE(in.isNew());
            REQUIRE(in.read());
            CHECK(received.data == i * 1000);
        }
    }
    ~LongToDoublePorts() {
        owner.exit();
        owner.removePort(out);
        owner.removePort(in);
    }
};

} // namespace

TEST_CASE("A serializer at either end of a connection lets a port of one type send to one of another") {
    const std::string serializer = GENERATE("outport.marshaling_type=cdr:RTC/TimedDouble:RTC/TimedLong",
                                            "inport.marshaling_type=cdr:RTC/TimedLong:RTC/TimedDouble");
    const std::string interface = GENERATE("corba_cdr", "data_service", "direct");
    const std::string flow = GENERATE("push", "pull");
    const std::string order = GENERATE("little", "big");
    CAPTURE(serializer, interface, flow, order);
    static ManagerFixture fixture;
    {
        LongToDoublePorts ports(fixture);
        fixture.connect("Recorder0.a?port=Recorder0.b&" + serializer + "&interface_type=" + interface +
                        "&dataflow_type=" + flow + "&serializer.cdr.endian=" + order);
        ports.check_values_arrive();
    }
    fixture.manager().cleanupComponents();
}

TEST_CASE("A serializer in the configuration of either port counts as one that the connection names") {
    const std::string serializer =
        GENERATE("port.outport.a.marshaling_type=cdr:RTC/TimedDouble:RTC/TimedLong",
                 "port.inport.b.marshaling_type=cdr:RTC/TimedLong:RTC/TimedDouble");
    const std::string interface = GENERATE("corba_cdr", "data_service", "direct");
    const std::string flow = GENERATE("push", "pull");
    CAPTURE(serializer, interface, flow);
    static ManagerFixture fixture;
    {
        LongToDoublePorts ports(fixture, serializer);
        const std::string line =
            "Recorder0.a?port=Recorder0.b&interface_type=" + interface + "&dataflow_type=" + flow;
        CHECK_THROWS_WITH(fixture.connect(line + "&marshaling_type=cdr"),
                          Catch::Contains("connect ports of one type"));
        fixture.connect(line);
        ports.check_values_arrive();
    }
    fixture.manager().cleanupComponents();
}

TEST_CASE("Ports of different types stay apart when nothing converts") {
    const std::string properties =
        GENERATE("", "&interface_type=direct", "&marshaling_type=cdr", "&inport.marshaling_type=cdr");
    CAPTURE(properties);
    static ManagerFixture fixture;
    {
        LongToDoublePorts ports(fixture);
        CHECK_THROWS_WITH(fixture.connect("Recorder0.a?port=Recorder0.b" + properties),
                          Catch::Contains("connect ports of one type"));
        CHECK(ports.out.getConnectorProfiles().empty());
    }
    fixture.manager().cleanupComponents();
}
