// SPDX-License-Identifier: Apache-2.0
#include "tests/host/opros/fixtures/MathProvided.h"
#include "tests/host/opros/fixtures/MathRequired.h"
#include "tests/host/opros/runtime/recording_archive.hpp"

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
    CHECK((*reinterpret_cast<ProvidedMethod<int>*>(grow.get()))(values) == 1);
    CHECK(values.empty()); // the method has changed its own copy
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

TEST_CASE("a bridge learns a method's signature from both sides") {
    Math math;
    MathProvided provided(&math);
    MathRequired required;
    for (ServicePortInterface* port :
         {static_cast<ServicePortInterface*>(&provided), static_cast<ServicePortInterface*>(&required)}) {
        TypeRecorder arguments, result;
        CHECK(port->getMethod("turn")->describe(arguments, result));
        CHECK(arguments.text == "(sa(dd)[3]i)i");
        CHECK(result.text == "(sa(dd)[3]i)");
        TypeRecorder none, nothing;
        CHECK(port->getMethod("note")->describe(none, nothing));
        CHECK(none.text == "s");
        CHECK(nothing.text.empty());
    }
}

TEST_CASE("a method with a type that cannot be archived can be called but not described") {
    struct Local {
        int size(int* p) { return p ? 1 : 0; }
    } local;
    const std::unique_ptr<Method> method(makeProvidedMethod(&Local::size, &local, "size"));
    int number = 0;
    int* pointer = &number;
    CHECK((*reinterpret_cast<ProvidedMethod<int>*>(method.get()))(pointer) == 1);
    TypeRecorder arguments, result;
    CHECK_FALSE(method->describe(arguments, result));
}
