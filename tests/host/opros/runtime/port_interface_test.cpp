// SPDX-License-Identifier: Apache-2.0
#include <Component.h>
#include <InputDataPort.h>
#include <ProvidedServicePort.h>
#include <SymbolService.h>

#include <catch2/catch.hpp>

namespace {
struct Counted : ProvidedServicePort {
    int& deaths;
    explicit Counted(int& d) : deaths(d) {}
    ~Counted() override { ++deaths; }
};
struct Exporting : Component {
    int level = 13;
    std::string text = "t";
    Exporting() {
        EXPORT_VARIABLE("level", level);
        EXPORT_VARIABLE("text", text);
    }
};
} // namespace

TEST_CASE("a component finds its ports by name and owns only service ports") {
    int deaths = 0;
    InputDataPort<int> data;
    {
        Component component;
        component.addPort("data", &data);
        component.addPort("service", new Counted(deaths));
        CHECK(component.getPort("data") == &data);
        CHECK(component.getPort("nothing") == nullptr);
        CHECK(component.getPortNames(OPROS_SERVICE) == std::vector<std::string>{"service"});
        component.addPort("service", new Counted(deaths));
        CHECK(deaths == 1);
        CHECK(component.addPort("none", nullptr) == OPROS_BAD_INPUT_PARAMETER);
    }
    CHECK(deaths == 2);
}

TEST_CASE("an absent property is empty, even after another absent one was written to") {
    Component component;
    component.setProperty("a", "1");
    CHECK(component.getProperty("a") == "1");
    component.getProperty("missing") = "written into nothing";
    CHECK(component.getProperty("missing").empty());
    CHECK(component.getPropertyMap().size() == 1);
}

namespace {
template <typename... Arguments>
opros_params call(ProvidedServicePort& port, std::string method, const Arguments&... arguments) {
    std::vector<opros_params> params{opros_params(arguments)...};
    opros_params result;
    REQUIRE(port.callService(method, params, result) == OPROS_SUCCESS);
    return result;
}
} // namespace

TEST_CASE("exported variables are read and written through the symbol port in either encoding") {
    Exporting component;
    auto* port = dynamic_cast<ProvidedServicePort*>(component.getPort("opros.symbol"));
    REQUIRE(port);
    const std::string name = "level";
    const auto value = [&] {
        opros_params text = call(*port, "getSymbolValue", name);
        return opros_params_cast<std::string>(text);
    };
    CHECK(value() == "I13;");
    opros_params done = call(*port, "setSymbolvalue", name, std::string("I14;"));
    CHECK(opros_params_cast<int>(done) == 0);
    CHECK(component.level == 14);
    done = call(*port, "setSymbolvalue", std::string("missing"), std::string("I14;"));
    CHECK(opros_params_cast<int>(done) == -1);

    call(*port, "setEncodingRule", OPROS_SYMBOL_ENCODING_BIN);
    const std::string binary = value();
    CHECK(binary == std::string("I\4\16\0\0\0", 6));
    call(*port, "setEncodingRule", static_cast<SymbolEncodingRule>(7)); // no such rule
    CHECK(value() == binary);
    component.level = 0;
    call(*port, "setSymbolvalue", name, binary);
    CHECK(component.level == 14);
}
