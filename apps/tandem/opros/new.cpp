// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/component_folder.hpp"
#include "apps/tandem/opros/commands.hpp"
#include "apps/tandem/output/print.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <stdexcept>

namespace tandem::command {
namespace {

// The header has all callbacks of the life cycle and of execution, so that authors see them without a manual.
// expand_template() replaces @NAME@ by the component's name.
constexpr char header[] = R"(#ifndef @NAME@_H_
#define @NAME@_H_

#include <Component.h>
#include <InputDataPort.h>
#include <OPRoSTypes.h>
#include <OutputDataPort.h>

// Multiplies each value of the port `in` by the property `gain` and sends the result through `out`.
class @NAME@ : public Component {
  public:
    @NAME@();

    virtual ReturnType onExecute();         // once per period
    virtual ReturnType onUpdated();         // after the onExecute() of all components of this period
    virtual ReturnType onEvent(Event* evt); // an event has arrived; may run in another thread
    virtual ReturnType onPeriodChanged();

  protected:
    virtual ReturnType onInitialize(); // properties are set, ports are not yet connected
    virtual ReturnType onStart();
    virtual ReturnType onStop();
    virtual ReturnType onReset();
    virtual ReturnType onError();
    virtual ReturnType onRecover();
    virtual ReturnType onDestroy();

  private:
    InputDataPort<double> in;
    OutputDataPort<double> out;
    double gain;
};

#endif
)";

constexpr char source[] = R"(#include "@NAME@.h"

#include <ServiceUtils.h> // getVersion(), in one source file only

#include <cstdlib>
#include <iostream>

@NAME@::@NAME@() : in(OPROS_LAST, 1), gain(1) {
    addPort("in", &in);
    addPort("out", &out);
}

ReturnType @NAME@::onInitialize() {
    gain = std::atof(getProperty("gain").c_str());
    return OPROS_SUCCESS;
}

ReturnType @NAME@::onStart() {
    std::cout << getId() << ": started, gain " << gain << std::endl;
    return OPROS_SUCCESS;
}

ReturnType @NAME@::onExecute() {
    opros_any* value = in.pop(); // NULL if no value has arrived; we must delete it
    if (value != NULL) out.push(gain * in.getContent(*value));
    delete value;
    return OPROS_SUCCESS;
}

ReturnType @NAME@::onUpdated() { return OPROS_SUCCESS; }
ReturnType @NAME@::onEvent(Event*) { return OPROS_SUCCESS; }
ReturnType @NAME@::onPeriodChanged() { return OPROS_SUCCESS; }
ReturnType @NAME@::onStop() { return OPROS_SUCCESS; }
ReturnType @NAME@::onReset() { return OPROS_SUCCESS; }
ReturnType @NAME@::onError() { return OPROS_SUCCESS; }
ReturnType @NAME@::onRecover() { return OPROS_SUCCESS; }
ReturnType @NAME@::onDestroy() { return OPROS_SUCCESS; }

extern "C" {
Component* getComponent() { return new @NAME@(); }
void releaseComponent(Component* component) { delete component; }
}
)";

// Contains the elements that the host needs and those that authors change most often.
constexpr char profile[] = R"(<?xml version="1.0" encoding="UTF-8"?>
<component_profile>
  <name>@NAME@</name>
  <description>Multiplies a number.</description>
  <execution_environment>
    <library_type>so</library_type>
    <library_name>@NAME@.so</library_name>
    <impl_language>c++</impl_language>
  </execution_environment>
  <!-- type: periodic, periodic-exclusive, periodic-shared, aperiodic, aperiodic-loop or passive; period in ms -->
  <execution_semantics>
    <type>periodic</type>
    <period>100</period>
    <priority>5</priority>
  </execution_semantics>
  <properties>
    <property name="gain" type="double">2</property>
  </properties>
  <ports>
    <data_port>
      <name>in</name>
      <usage>input</usage>
      <data_type>double</data_type>
    </data_port>
    <data_port>
      <name>out</name>
      <usage>output</usage>
      <data_type>double</data_type>
    </data_port>
  </ports>
</component_profile>
)";

// Connects the component to itself, so that the application runs without a second component.
constexpr char application[] = R"(<?xml version="1.0" encoding="UTF-8"?>
<package_profile>
  <name>@NAME@App</name>
  <subcomponents>
    <subcomponent>
      <name>@NAME@</name>
      <reference>@NAME@.xml</reference>
    </subcomponent>
  </subcomponents>
  <!-- <port_connection port_type="data">: from the output port of source to the input port of target -->
  <port_connections>
    <port_connection port_type="data">
      <source component_name="@NAME@" port_name="out"/>
      <target component_name="@NAME@" port_name="in"/>
    </port_connection>
  </port_connections>
</package_profile>
)";

// For larger projects. tandem opros build asks CMake for the sources in it.
constexpr char build[] = R"(cmake_minimum_required(VERSION 3.16)
project(@NAME@ CXX)
find_package(Tandem REQUIRED COMPONENTS opros)
tandem_add_opros_component(@NAME@)
)";

/// Returns a component with an input, an output and a property, its profile, an application, and a CMakeLists.txt.
TemplateFiles opros_component_template(const std::string& name) {
    return {{name + ".h", expand_template(header, name)},
            {name + ".cpp", expand_template(source, name)},
            {name + ".xml", expand_template(profile, name)},
            {name + "App.xml", expand_template(application, name)},
            {"CMakeLists.txt", expand_template(build, name)}};
}

// API names that the template uses, and functions that it defines. A class must not have such a name.
constexpr std::array<const char*, 8> api_names{"Component",        "Event",        "InputDataPort",
                                               "OutputDataPort",   "getComponent", "getVersion",
                                               "releaseComponent", "ReturnType"};

} // namespace

int opros_new(const std::string& name, const std::filesystem::path& parent) {
    require_component_name(name);
    if (std::find(api_names.begin(), api_names.end(), name) != api_names.end())
        throw std::runtime_error("'" + name +
                                 "' is not a valid component name: the OPRoS API has a class with this name");
    const auto folder = parent / name;
    create_component_folder(folder, opros_component_template(name));
    // The output contains the next two commands to copy.
    const std::string shown = folder.lexically_normal().string();
    print_text(fmt::format("{0}: component {1}, its profile, and an application with it. Next:\n"
                           "  tandem opros build {0}\n"
                           "  opros_host {0}/{1}App.xml\n",
                           shown, name));
    return 0;
}

} // namespace tandem::command
