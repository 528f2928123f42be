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

TEST_CASE("a property that is not set is empty, whatever was done to the last one that was not set") {
    Component component;
    component.setProperty("a", "1");
    CHECK(component.getProperty("a") == "1");
    component.getProperty("missing") = "written into nothing";
    CHECK(component.getProperty("missing").empty());
    CHECK(component.getPropertyMap().size() == 1);
}

TEST_CASE("exported variables are read and written through the symbol port") {
    Exporting component;
    auto* port = dynamic_cast<ProvidedServicePort*>(component.getPort("opros.symbol"));
    REQUIRE(port);
    std::string method = "getSymbolValue";
    std::vector<opros_params> name{opros_params(std::string("level"))};
    opros_params value;
    REQUIRE(port->callService(method, name, value) == OPROS_SUCCESS);
    component.level = 0;
    std::vector<opros_params> both{name[0], value};
    std::string setter = "setSymbolvalue";
    opros_params done;
    REQUIRE(port->callService(setter, both, done) == OPROS_SUCCESS);
    CHECK(component.level == 13);
}
