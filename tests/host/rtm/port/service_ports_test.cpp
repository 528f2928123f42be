// SPDX-License-Identifier: Apache-2.0
#include "tests/host/rtm/manager_fixture.hpp"

#include <atomic>
#include <thread>

using namespace testing;

namespace {

double sum_of(CalculatorConsumer& consumer, std::initializer_list<double> values) {
    Testing::Numbers numbers;
    for (double v : values) CORBA_SeqUtil::push_back(numbers, v);
    return consumer.calculator_->sum(numbers);
}

} // namespace

TEST_CASE("A consumer calls the provider of the same type and instance while it is active") {
    ManagerFixture fixture;
    auto& provider = fixture.create<CalculatorProvider>("CalculatorProvider");
    auto& consumer = fixture.create<CalculatorConsumer>("CalculatorConsumer");
    CHECK_THROWS_AS(sum_of(consumer, {1}), CORBA::SystemException);
    fixture.connect("CalculatorConsumer0.calculator?port=CalculatorProvider0.calculator");
    CHECK_THROWS_AS(sum_of(consumer, {1}), CORBA::OBJECT_NOT_EXIST);

    fixture.activate(provider);
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

TEST_CASE("A consumer calls a provider of its process without the ORB's dispatcher") {
    /// The ORB knows the servant's object while it dispatches a call to it.
    struct Witness : Calculator {
        char* name() override {
            CORBA::Object_var object =
                RTC::Manager::instance().theORB()->resolve_initial_references("POACurrent");
            PortableServer::Current_var current = PortableServer::Current::_narrow(object.in());
            try {
                PortableServer::POA_var poa = current->get_POA();
                return CORBA::string_dup("dispatched");
            } catch (const PortableServer::Current::NoContext&) {
                return CORBA::string_dup("direct");
            }
        }
    } witness;
    ManagerFixture fixture;
    auto& provider = fixture.create<Recorder>("Recorder");
    auto& consumer = fixture.create<CalculatorConsumer>("CalculatorConsumer");
    RTC::CorbaPort port("calculator");
    REQUIRE(port.registerProvider("calc", "Testing::Calculator", witness));
    provider.addPort(port);
    fixture.connect("CalculatorConsumer0.calculator?port=Recorder0.calculator");
    fixture.activate(provider);
    consumer.calculator_->calls(); // the first call finds the servant
    CHECK(std::string(CORBA::String_var(consumer.calculator_->name()).in()) == "direct");
    provider.deactivate(0);
    CHECK_THROWS_AS(consumer.calculator_->calls(), CORBA::OBJECT_NOT_EXIST);
    provider.removePort(port);
}

namespace {

/// A call of it runs until end() or for 20 s.
class SlowCalculator : public Calculator {
  public:
    char* name() override {
        runs_ = true;
        for (int i = 0; i < 2000 && !ended_; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
        runs_ = false;
        return CORBA::string_dup("slow");
    }
    void end() { ended_ = true; }
    bool runs() const { return runs_; }

  private:
    std::atomic<bool> runs_{false}, ended_{false};
};

bool soon(const std::function<bool()>& holds) {
    for (int i = 0; i < 2000 && !holds(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return holds();
}

/// A component whose service has a call that runs, and has become active again since that call began.
struct ActiveAgain {
    ActiveAgain() {
        REQUIRE(port.registerProvider("calc", "Testing::Calculator", servant));
        provider.addPort(port);
        fixture.connect("CalculatorConsumer0.calculator?port=Recorder0.calculator");
        fixture.activate(provider);
        caller = std::thread([this] {
            // By the ORB's dispatcher, which counts it as a call of the object.
            const CORBA::Request_var request = consumer.calculator_->_request("_get_name");
            request->set_return_type(CORBA::_tc_string);
            request->invoke();
        });
        CHECK(soon([this] { return servant.runs(); }));
        CHECK(provider.deactivate(0) == RTC::RTC_OK);
        CHECK(provider.activate(0) == RTC::RTC_OK);
        CHECK(ManagerFixture::state(provider) == RTC::ACTIVE_STATE);
        CHECK(servant.runs());
    }
    ~ActiveAgain() {
        servant.end();
        if (caller.joinable()) caller.join();
        provider.removePort(port);
    }

    SlowCalculator servant;
    ManagerFixture fixture;
    Recorder& provider = fixture.create<Recorder>("Recorder");
    CalculatorConsumer& consumer = fixture.create<CalculatorConsumer>("CalculatorConsumer");
    RTC::CorbaPort port{"calculator"};
    std::thread caller;
};

} // namespace

TEST_CASE("A component becomes active again while a call of its service still runs, and provides it then") {
    ActiveAgain component;
    component.servant.end();
    component.caller.join();
    CHECK(soon([&] {
        try {
            return component.consumer.calculator_->calls() >= 0;
        } catch (const CORBA::SystemException&) {
            return false;
        }
    }));
    component.provider.deactivate(0);
    CHECK_THROWS_AS(component.consumer.calculator_->calls(), CORBA::OBJECT_NOT_EXIST);
}

TEST_CASE("A port that has retired does not activate a servant any more, which may be destroyed then") {
    ActiveAgain component; // the activation waits for the call
    std::thread end([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        component.servant.end();
    });
    component.port.retire();
    CHECK_FALSE(component.servant.runs());
    end.join();
}

TEST_CASE("A strict connection without a matching provider is refused, a lenient one is not") {
    ManagerFixture fixture;
    fixture.create<CalculatorConsumer>("CalculatorConsumer");
    fixture.create<CalculatorConsumer>("CalculatorConsumer");
    CHECK_THROWS_WITH(
        fixture.connect("CalculatorConsumer0.calculator?port=CalculatorConsumer1.calculator&port."
                        "connection.strictness=strict"),
        Catch::Contains("no provider for Testing::Calculator"));
    CHECK_NOTHROW(fixture.connect("CalculatorConsumer0.calculator?port=CalculatorConsumer1.calculator"));
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
    ManagerFixture fixture;
    auto& provider = fixture.create<Recorder>("Recorder");
    auto& consumer = fixture.create<CalculatorConsumer>("CalculatorConsumer");
    AnyServant servant;
    RTC::CorbaPort port("calculator");
    REQUIRE(port.registerProvider("calc", "Testing::Calculator", servant));
    CHECK_FALSE(port.registerProvider("calc", "Testing::Calculator", servant));
    provider.addPort(port);
    fixture.connect("CalculatorConsumer0.calculator?port=Recorder0.calculator");
    fixture.activate(provider);
    CHECK(sum_of(consumer, {1, 2}) == 99);
    CHECK(servant.operation == "sum");
    provider.deactivate(0);
    provider.removePort(port);
}

TEST_CASE(
    "An explicit mapping chooses the provider whatever its instance name and nil leaves the consumer empty") {
    ManagerFixture fixture;
    auto& first = fixture.create<CalculatorProvider>("CalculatorProvider");
    auto& consumer = fixture.create<CalculatorConsumer>("CalculatorConsumer");
    Calculator other;
    REQUIRE(first.port_.registerProvider("other", "Testing::Calculator", other));
    fixture.activate(first);
    const std::string required = "CalculatorConsumer0.port.calculator.required.Testing::Calculator.calc";
    const std::string provided = "CalculatorProvider0.port.calculator.provided.Testing::Calculator.other";
    auto connect = [&](const std::string& to) {
        RTC::ConnectorProfile profile;
        profile.name = CORBA::string_dup("mapped");
        profile.ports.length(2);
        profile.ports[0] = first.port_.getPortRef();
        profile.ports[1] = consumer.port_.getPortRef();
        CORBA_SeqUtil::push_back(profile.properties, NVUtil::newNV(required.c_str(), to.c_str()));
        CORBA_SeqUtil::push_back(profile.properties, NVUtil::newNV("port.connection.strictness", "strict"));
        return first.port_.connect(profile);
    };
    REQUIRE(connect(provided) == RTC::RTC_OK);
    CHECK(sum_of(consumer, {1, 2}) == 3);
    CHECK(other.calls() == 1);
    consumer.port_.disconnect_all();
    CHECK(CORBA::is_nil(consumer.calculator_._ptr()));
    REQUIRE(connect("nil") == RTC::RTC_OK);
    CHECK(CORBA::is_nil(consumer.calculator_._ptr()));
    consumer.port_.disconnect_all();
    first.deactivate(0);
}
