// SPDX-License-Identifier: Apache-2.0
// What a bridge needs: ports of a type known at run time, buffers that it provides, signatures.
#include "tests/host/rtm/manager_fixture.hpp"
#include <rtm/CdrRingBuffer.h>
#include <rtm/InterfaceSignatures.h>

using namespace testing;

namespace {

struct RawIn : RTC::InPortBase {
    RawIn(const char* name, const char* type) : InPortBase(name, type) {
        addProperty("dataport.marshaling_types", "cdr");
    }
    bool read(std::string = "") override {
        return !m_connectors.empty() && m_connectors[0]->read(bytes) == RTC::DataPortStatus::PORT_OK;
    }
    RTC::ByteData bytes;
};
struct RawOut : RTC::OutPortBase {
    RawOut(const char* name, const char* type) : OutPortBase(name, type) {
        addProperty("dataport.marshaling_types", "cdr");
    }
    bool write() override {
        return !m_connectors.empty() && m_connectors[0]->write(bytes) == RTC::DataPortStatus::PORT_OK;
    }
    RTC::ByteData bytes;
};

// Hands out whatever `next` says, as a bridge's shared memory would.
struct BridgeBuffer : RTC::CdrRingBuffer {
    static std::string& initialised_with() {
        static std::string name;
        return name;
    }
    static std::vector<long>& next() {
        static std::vector<long> values;
        return values;
    }
    void init(const coil::Properties& prop) override { initialised_with() = prop.getProperty("ring"); }
    std::size_t readable() const override { return next().size(); }
    RTC::BufferStatus read(RTC::ByteData& bytes, std::chrono::nanoseconds) override {
        if (next().empty()) return RTC::BufferStatus::EMPTY;
        RTC::CORBA_CdrMemoryStream stream;
        RTC::TimedLong value{};
        value.data = static_cast<CORBA::Long>(next().front());
        next().erase(next().begin());
        stream.serializeCDR(value);
        bytes.writeData(stream.getBuffer(), stream.getCdrDataLength());
        return RTC::BufferStatus::OK;
    }
};

} // namespace

TEST_CASE("Raw ports of a type known at run time exchange the bytes with typed ports") {
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    auto& accumulator = fixture.create<Accumulator>("Accumulator");
    RawIn in("raw_in", "IDL:RTC/TimedLong:1.0");
    RawOut out("raw_out", "IDL:RTC/TimedLong:1.0");
    counter.addInPort("raw_in", in);
    counter.addOutPort("raw_out", out);
    fixture.connect("Counter0.out?port=Counter0.raw_in");
    fixture.connect("Counter0.raw_out?port=Accumulator0.in");

    counter.value_.data = 77;
    counter.out_.write();
    REQUIRE(in.isNew());
    REQUIRE(in.read());
    CHECK(in.bytes.getDataLength() == 12);
    CHECK(in.bytes.getEndian());
    out.bytes = in.bytes;
    REQUIRE(out.write());
    REQUIRE(accumulator.in_.read());
    CHECK(accumulator.value_.data == 77);

    out.bytes.setDataLength(5); // not a TimedLong
    out.write();
    CHECK_FALSE(accumulator.in_.read());
    CHECK(accumulator.in_.getStatus(0) == RTC::DataPortStatus::BUFFER_ERROR);
    counter.removePort(in);
    counter.removePort(out);
}

TEST_CASE("A connector that names a buffer type gets its own buffer from the factory, in addition to the "
          "shared one") {
    ManagerFixture fixture;
    RTC::CdrBufferFactory::instance().addFactory("bridge", coil::Creator<RTC::CdrBufferBase, BridgeBuffer>,
                                                 coil::Destructor<RTC::CdrBufferBase, BridgeBuffer>);
    auto& counter = fixture.create<Counter>("Counter");
    auto& accumulator = fixture.create<Accumulator>("Accumulator");
    RawOut out("raw_out", "IDL:RTC/TimedLong:1.0");
    counter.addOutPort("raw_out", out);
    fixture.connect("Counter0.raw_out?port=Accumulator0.in&inport.buffer_type=bridge&buffer.ring=link/7");
    fixture.connect("Counter0.out?port=Accumulator0.in");
    CHECK(BridgeBuffer::initialised_with() == "link/7");

    CHECK_FALSE(accumulator.in_.isNew());
    BridgeBuffer::next() = {3, 4};
    counter.value_.data = 50;
    counter.out_.write();
    fixture.activate(accumulator);
    fixture.step(accumulator);
    CHECK(accumulator.sum_ == 57);
    CHECK(accumulator.received_ == 3);
    counter.removePort(out);
}

TEST_CASE("Signatures of data types and of service operations are known at run time") {
    using RTC::InterfaceSignatures;
    CHECK(InterfaceSignatures::type("IDL:RTC/TimedDouble:1.0") == "{tm}({sec}u{nsec}u){data}d");
    CHECK(InterfaceSignatures::type("IDL:RTC/TimedDoubleSeq:1.0") == "{tm}({sec}u{nsec}u){data}ad");
    CHECK(InterfaceSignatures::type("IDL:RTC/CameraImage:1.0") ==
          "{tm}({sec}u{nsec}u){width}q{height}q{bpp}q{format}s{fDiv}d{pixels}ay");
    CHECK(InterfaceSignatures::type("IDL:No/Such:1.0").empty());
    CORBA::TypeCode_var code = CORBA_Util::typeCodeOf<RTC::TimedDoubleSeq>();
    CHECK(InterfaceSignatures::signature(code.in()) == "({tm}({sec}u{nsec}u){data}ad)");

    CHECK(InterfaceSignatures::repositoryId("Testing::Calculator") == "IDL:Testing/Calculator:1.0");
    CHECK(InterfaceSignatures::find("alculator") == nullptr);
    const auto* operations = InterfaceSignatures::find("Calculator");
    REQUIRE(operations != nullptr);
    std::string all;
    for (const auto& o : *operations) all += o.name + " " + o.arguments + ":" + o.result + "\n";
    CHECK(
        all ==
        "_get_calls :{value}i\n_get_name :{value}s\n_set_calls {value}i:\n"
        "divide {dividend}i{divisor}i>{rest}i:i\nrange_of {values}ad:({low}d{high}d)\nset_mode {wanted}e#2:\n"
        "stamped {value}({tm}({sec}u{nsec}u){data}d):({tm}({sec}u{nsec}u){data}d)\nsum {values}ad:d\n");
}
