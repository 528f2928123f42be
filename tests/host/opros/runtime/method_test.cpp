// SPDX-License-Identifier: Apache-2.0
#include "tests/host/opros/fixtures/MathProvided.h"
#include "tests/host/opros/fixtures/MathRequired.h"
#include "tests/host/opros/runtime/recording_archive.hpp"
#include "tests/support/allocations.hpp"

#include <catch2/catch.hpp>
#include <memory>

namespace {

class Math : public IMath {
  public:
    std::string noted;
    double add(double a, double b) override { return a + b; }
    Pose turn(Pose pose, int times) override {
        pose.weights[0] = times;
        return pose;
    }
    void note(std::string text) override { noted = text; }
    int grow(std::vector<int>& values) {
        values.push_back(1);
        return static_cast<int>(values.size());
    }
    std::string name(const std::string& first, const char* second) const { return first + second; }
};
std::vector<std::string> names_and_points(std::map<std::string, std::vector<Point>>, std::wstring) {
    return {};
}
int twice(int value) { return 2 * value; }

void connect(MathRequired& required, MathProvided& provided) {
    for (auto it = required.getFirst(); it != required.getEnd(); ++it)
        REQUIRE(static_cast<RequiredMethodInterface*>(it->second)->Connect(provided.getMethod(it->first)) ==
                OPROS_SUCCESS);
}

template <typename F>
std::string message_of(F call) {
    try {
        call();
    } catch (MethodInvokeException& error) {
        return error.getMessage();
    }
    return "no exception";
}

} // namespace

TEST_CASE("a call through generated service headers reaches the component") {
    Math math;
    MathProvided provided(&math);
    MathRequired required;
    connect(required, provided);
    CHECK(required.add(1, 2.5) == 3.5);
    Pose pose;
    pose.frame = "f";
    CHECK(required.turn(pose, 3).weights[0] == 3);
    CHECK(required.turn(pose, 3).frame == "f");
    required.note("text");
    CHECK(math.noted == "text");
    CHECK(provided.add(2, 2) == 4);
}

TEST_CASE("a call of a method that is not connected names the method") {
    MathRequired required;
    CHECK(message_of([&] { required.add(1, 2); }).find("add") != std::string::npos);
}

TEST_CASE("methods of different types are not connected, and the signatures tell the types") {
    MathRequired required;
    Math math;
    const std::unique_ptr<Method> other(makeProvidedMethod(&twice, "add"));
    auto* add = static_cast<RequiredMethodInterface*>(required.getMethod("add"));
    CHECK(add->Connect(other.get()) == OPROS_BAD_INPUT_PARAMETER);
    CHECK(add->signature() == "double (double, double)");
    CHECK(other->signature() == "int (int)");
}

TEST_CASE("a signature names standard types without their default arguments") {
    const std::unique_ptr<Method> method(makeProvidedMethod(&names_and_points, "f"));
    CHECK(method->signature() ==
          "std::vector<std::string> (std::map<std::string, std::vector<Point>>, std::wstring)");
}

TEST_CASE("a call with a wrong number or wrong types of arguments is refused") {
    Math math;
    const std::unique_ptr<Method> method(makeProvidedMethod(&Math::add, &math, "add"));
    auto& add = *reinterpret_cast<ProvidedMethod<double>*>(method.get());
    CHECK_THROWS_AS(add(1.0), ArgumentNumberException);
    CHECK(message_of([&] { add(1, 2); }).find("double (double, double)") != std::string::npos);
}

TEST_CASE("references, const methods and free functions are provided as well") {
    Math math;
    std::vector<int> values;
    const std::unique_ptr<Method> grow(makeProvidedMethod(&Math::grow, &math, "grow"));
    auto& grow_call = *reinterpret_cast<ProvidedMethod<int>*>(grow.get());
    CHECK(grow_call(values) == 1);
    CHECK(values == std::vector<int>{1}); // the caller's variable
    const std::vector<int> constant = values;
    CHECK(grow_call(constant) == 2); // a copy of what is const
    CHECK(constant.size() == 1);
    CHECK(grow_call(std::vector<int>{1, 2}) == 3);
    const std::unique_ptr<Method> name(makeProvidedMethod(&Math::name, &math, "name"));
    const char* second = "b";
    CHECK((*reinterpret_cast<ProvidedMethod<std::string>*>(name.get()))(std::string("a"), second) == "ab");
    const std::unique_ptr<Method> function(makeProvidedMethod(&twice, "twice"));
    CHECK((*reinterpret_cast<ProvidedMethod<int>*>(function.get()))(4) == 8);
}

TEST_CASE("a provided port is called by name with encoded arguments") {
    Math math;
    MathProvided provided(&math);
    BinaryPipe arguments, result;
    arguments.out << 1.5 << 2.0;
    std::string name = "add";
    REQUIRE(provided.callService(name, arguments.in, result.out) == OPROS_SUCCESS);
    double sum = 0;
    result.in >> sum;
    CHECK(sum == 3.5);
    std::string unknown = "divide";
    CHECK(provided.callService(unknown, arguments.in, result.out) == OPROS_UNSUPPORTED_METHOD);
}

TEST_CASE("a provided port is called by name with values, of the right number and types") {
    Math math;
    MathProvided provided(&math);
    std::vector<opros_params> params{opros_params(1.0), opros_params(2.0)};
    opros_params result;
    std::string name = "add";
    CHECK(provided.callService(name, params, result) == OPROS_SUCCESS);
    CHECK(*opros_params_cast<double>(&result) == 3);
    params[1] = 2;
    CHECK(provided.callService(name, params, result) == OPROS_BAD_INPUT_PARAMETER);
    params.pop_back();
    CHECK(provided.callService(name, params, result) == OPROS_BAD_INPUT_PARAMETER);
}

namespace {

/// Keeps what a method says of itself as text: result, colon, arguments, `&` before those that it may write.
struct Description : MethodDescription {
    TypeRecorder result_type;
    std::vector<std::unique_ptr<TypeRecorder>> arguments;
    std::vector<bool> writable;
    opros::archive::iarchive& result() override { return result_type; }
    opros::archive::iarchive& argument(bool may_write) override {
        writable.push_back(may_write);
        arguments.push_back(std::make_unique<TypeRecorder>());
        return *arguments.back();
    }
    std::string text() const {
        std::string all = result_type.text + ":";
        for (std::size_t i = 0; i < arguments.size(); ++i)
            all += (i ? " " : "") + std::string(writable[i] ? "&" : "") + arguments[i]->text;
        return all;
    }
};

struct Limits {
    bool read(int axis, double& low, std::vector<int>* steps, const std::string& unit, const double* scale) {
        low = -axis * *scale;
        if (steps) steps->push_back(static_cast<int>(unit.size()));
        return true;
    }
};

/// Calls the port with the caller's values, as the connector of a bridge in the same process.
struct ValueConnector : ServicePortConnector {
    ProvidedMethodInterface& method;
    explicit ValueConnector(ProvidedMethodInterface& m) : method(m) {}
    ReturnType requestService(const std::string&, std::vector<opros_params>& params, opros_params& result,
                              int) override {
        return method.call(params, result);
    }
    ReturnType responseService(std::string&, std::string&, std::string&) override {
        return OPROS_UNSUPPORTED_METHOD;
    }
};

class LimitsRequired : public RequiredServicePort {
  public:
    LimitsRequired() { addMethod("read", makeRequiredMethod(&LimitsRequired::read, "read")); }
    bool read(int axis, double& low, std::vector<int>* steps, const std::string& unit, const double* scale) {
        return (*reinterpret_cast<RequiredMethod<bool>*>(getMethod("read")))(axis, low, steps, unit, scale);
    }
};

} // namespace

TEST_CASE("a bridge learns a method's signature from both sides") {
    Math math;
    MathProvided provided(&math);
    MathRequired required;
    for (ServicePortInterface* port :
         {static_cast<ServicePortInterface*>(&provided), static_cast<ServicePortInterface*>(&required)}) {
        Description turn, note;
        CHECK(port->getMethod("turn")->describe(turn));
        CHECK(turn.text() == "(sa(dd)[3]i):(sa(dd)[3]i) i");
        CHECK(port->getMethod("note")->describe(note));
        CHECK(note.text() == ":s");
    }
    Limits limits;
    Description read;
    CHECK(std::unique_ptr<Method>(makeProvidedMethod(&Limits::read, &limits, "read"))->describe(read));
    CHECK(read.text() == "b:i &d &ai s d");
}

TEST_CASE(
    "what a method writes to references and pointers reaches the caller directly and through a connector") {
    Limits limits;
    LimitsRequired required;
    const std::unique_ptr<Method> provided(makeProvidedMethod(&Limits::read, &limits, "read"));
    ValueConnector connector(static_cast<ProvidedMethodInterface&>(*provided));
    auto& method = static_cast<RequiredMethodInterface&>(*required.getMethod("read"));
    if (GENERATE(true, false))
        REQUIRE(method.Connect(provided.get()) == OPROS_SUCCESS);
    else
        REQUIRE(method.Connect(&connector) == OPROS_SUCCESS);
    double low = 0;
    const double scale = 0.5;
    std::vector<int> steps{7};
    CHECK(required.read(3, low, &steps, "mm", &scale));
    CHECK(low == -1.5);
    CHECK(steps == std::vector<int>{7, 2});
}

namespace {

/// Takes calls with the values where the caller has them: adds numbers up, or hands the call back.
struct PlaceConnector : ServicePortConnector {
    ReturnType requestService(const std::string&, std::vector<opros_params>& params, opros_params& result,
                              int) override {
        ++copied;
        result = *opros_params_cast<double>(&params[0]) - *opros_params_cast<double>(&params[1]);
        return OPROS_SUCCESS;
    }
    ReturnType requestEncoded(Method& method, const CallValue* arguments, int count,
                              const CallValue& result) override {
        if (refuses) return OPROS_UNSUPPORTED_METHOD;
        right_method = method.getName() == "add"; // an assertion here would allocate
        double sum = 0;
        for (int i = 0; i < count; ++i) sum += *static_cast<double*>(arguments[i].address);
        *static_cast<double*>(result.address) = sum;
        return OPROS_SUCCESS;
    }
    ReturnType responseService(std::string&, std::string&, std::string&) override {
        return OPROS_UNSUPPORTED_METHOD;
    }
    bool refuses = false, right_method = false;
    int copied = 0;
};

} // namespace

TEST_CASE("a connector gets the caller's own values without an allocation, or copies") {
    MathRequired required;
    PlaceConnector connector;
    static_cast<RequiredMethodInterface&>(*required.getMethod("add")).Connect(&connector);
    const long before = allocations();
    const double sum = required.add(1.5, 2);
    CHECK(allocations() == before);
    CHECK(sum == 3.5);
    CHECK(connector.right_method);
    CHECK(connector.copied == 0);
    connector.refuses = true;
    CHECK(required.add(1.5, 2) == -0.5);
    CHECK(connector.copied == 1);
}

TEST_CASE("an encoded call loads what is sent and saves what was written") {
    Limits limits;
    const std::unique_ptr<Method> method(makeProvidedMethod(&Limits::read, &limits, "read"));
    struct Call : EncodedCall {
        BinaryPipe in, out;
        // Argument 1 is not sent, and argument 2 is not returned.
        opros::archive::iarchive* argument(int index) override { return index == 1 ? nullptr : &in.in; }
        opros::archive::oarchive& result() override { return out.out; }
        opros::archive::oarchive* written_argument(int index) override {
            return index == 1 ? &out.out : nullptr;
        }
    } call;
    call.in.out << 4 << std::vector<int>{1} << std::string("mm") << 2.0;
    REQUIRE(static_cast<ProvidedMethodInterface&>(*method).call(call) == OPROS_SUCCESS);
    bool result = false;
    double low = 0;
    call.out.in >> result >> low;
    CHECK(result);
    CHECK(low == -8);
}

TEST_CASE("an exception with an id has fields of their types") {
    const MethodInvokeException error("too fast", "IDL:Chair/TooFast:1.0", 2.5, std::string("left"));
    CHECK(error.getId() == "IDL:Chair/TooFast:1.0");
    double speed = 0;
    std::string wheel;
    CHECK(error.getFields(speed, wheel));
    CHECK((speed == 2.5 && wheel == "left"));
    int wrong = 1;
    CHECK_FALSE(error.getFields(wrong, wheel));
    CHECK_FALSE(error.getFields(speed));
    CHECK(wrong == 1);
    CHECK(MethodInvokeException("plain").getId().empty());
    CHECK_FALSE(MethodInvokeException("plain").getFields(speed));
}

TEST_CASE("a method with a type that cannot be archived can be called but not described") {
    struct Local {
        int size(void* p) { return p ? 1 : 0; }
    } local;
    const std::unique_ptr<Method> method(makeProvidedMethod(&Local::size, &local, "size"));
    int number = 0;
    void* pointer = &number;
    CHECK((*reinterpret_cast<ProvidedMethod<int>*>(method.get()))(pointer) == 1);
    Description description;
    CHECK_FALSE(method->describe(description));
}
