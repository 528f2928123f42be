// SPDX-License-Identifier: Apache-2.0
#include "fixture.hpp"

using namespace testing;

namespace {

double sum_of(CalculatorConsumer& consumer, std::initializer_list<double> values) {
    Testing::Numbers numbers;
    for (double v : values) CORBA_SeqUtil::push_back(numbers, v);
    return consumer.calculator_->sum(numbers);
}

} // namespace

TEST_CASE("A consumer calls the provider of the same type and instance while it is active") {
    Stage stage;
    auto& provider = stage.create<CalculatorProvider>("CalculatorProvider");
    auto& consumer = stage.create<CalculatorConsumer>("CalculatorConsumer");
    CHECK_THROWS_AS(sum_of(consumer, {1}), CORBA::SystemException);
    stage.connect("CalculatorConsumer0.calculator?port=CalculatorProvider0.calculator");
    CHECK_THROWS_AS(sum_of(consumer, {1}), CORBA::OBJECT_NOT_EXIST);

    stage.activate(provider);
    CHECK(sum_of(consumer, {1, 2, 3.5}) == 6.5);
    CORBA::Long rest = 0;
    CHECK(consumer.calculator_->divide(17, 5, rest) == 3);
    CHECK(rest == 2);
    provider.deactivate(0);
    CHECK_THROWS_AS(sum_of(consumer, {1}), CORBA::OBJECT_NOT_EXIST);
    provider.activate(0);
    CHECK(sum_of(consumer, {4}) == 4);

    consumer.port_.disconnect_all();
    CHECK(CORBA::is_nil(consumer.calculator_._ptr()));
}

TEST_CASE("A strict connection without a matching provider is refused, a lenient one is not") {
    Stage stage;
    stage.create<CalculatorConsumer>("CalculatorConsumer");
    stage.create<CalculatorConsumer>("CalculatorConsumer");
    CHECK_THROWS_WITH(stage.connect("CalculatorConsumer0.calculator?port=CalculatorConsumer1.calculator&port."
                                    "connection.strictness=strict"),
                      Catch::Contains("no provider for Testing::Calculator"));
    CHECK_NOTHROW(stage.connect("CalculatorConsumer0.calculator?port=CalculatorConsumer1.calculator"));
}

namespace {

/// Any interface, without generated code: what a bridge registers.
class AnyServant : public PortableServer::DynamicImplementation {
  public:
    void invoke(CORBA::ServerRequest_ptr request) override {
        operation = request->operation();
        CORBA::ORB_ptr orb = RTC::Manager::instance().theORB();
        CORBA::NVList_ptr list;
        orb->create_list(0, list);
        CORBA::Any numbers;
        numbers.replace(Testing::_tc_Numbers, nullptr);
        list->add_value("values", numbers, CORBA::ARG_IN);
        request->arguments(list);
        CORBA::Any result;
        result <<= 99.0;
        request->set_result(result);
    }
    char* _primary_interface(const PortableServer::ObjectId&, PortableServer::POA_ptr) override {
        return CORBA::string_dup("IDL:Testing/Calculator:1.0");
    }
    const char* _mostDerivedRepoId() override { return "IDL:Testing/Calculator:1.0"; }
    CORBA::Boolean _is_a(const char* id) override { return std::string(id) == "IDL:Testing/Calculator:1.0"; }
    std::string operation;
};

} // namespace

TEST_CASE("A provider may be a servant of an interface known at run time") {
    Stage stage;
    auto& provider = stage.create<Recorder>("Recorder");
    auto& consumer = stage.create<CalculatorConsumer>("CalculatorConsumer");
    AnyServant servant;
    RTC::CorbaPort port("calculator");
    REQUIRE(port.registerProvider("calc", "Testing::Calculator", servant));
    CHECK_FALSE(port.registerProvider("calc", "Testing::Calculator", servant));
    provider.addPort(port);
    stage.connect("CalculatorConsumer0.calculator?port=Recorder0.calculator");
    stage.activate(provider);
    CHECK(sum_of(consumer, {1, 2}) == 99);
    CHECK(servant.operation == "sum");
    provider.deactivate(0);
    provider.removePort(port);
}
