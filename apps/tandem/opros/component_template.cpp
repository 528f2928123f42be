// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/opros/component_template.hpp"

namespace tandem::command {
namespace {

// expand_template() replaces @NAME@ by the component's name.
// Contains all callbacks of the life cycle and of execution, so that authors see them without a manual.
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
  <!-- type: periodic, periodic-shared, aperiodic or passive; period in ms -->
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

// For larger projects. tandem opros build does not read it.
constexpr char build[] = R"(cmake_minimum_required(VERSION 3.16)
project(@NAME@ CXX)
find_package(Tandem REQUIRED COMPONENTS opros)
tandem_add_opros_component(@NAME@)
)";

} // namespace

TemplateFiles opros_component_template(const std::string& name) {
    return {{name + ".h", expand_template(header, name)},
            {name + ".cpp", expand_template(source, name)},
            {name + ".xml", expand_template(profile, name)},
            {name + "App.xml", expand_template(application, name)},
            {"CMakeLists.txt", expand_template(build, name)}};
}

} // namespace tandem::command
