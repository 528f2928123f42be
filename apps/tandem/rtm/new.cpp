// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/component_folder.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/rtm/commands.hpp"

#include <fmt/format.h>

namespace tandem::command {
namespace {

// expand_template() replaces @NAME@ by the component's name. The style is that of RTCBuilder's output.
// The callbacks are those of RTC::RTObject_impl. A comment names those that the component does not need.
constexpr char rtc_header[] = R"(#ifndef @NAME@_H
#define @NAME@_H

#include <rtm/idl/BasicDataTypeSkel.h> // must precede the ports, as OpenRTM-aist requires

#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/Manager.h>

// Multiplies each value of the port `in` by the parameter `gain` and sends the result through `out`.
class @NAME@ : public RTC::DataFlowComponentBase {
 public:
  explicit @NAME@(RTC::Manager* manager);
  ~@NAME@() override;

  RTC::ReturnCode_t onInitialize() override; // registers ports and parameters
  RTC::ReturnCode_t onActivated(RTC::UniqueId ec_id) override;
  RTC::ReturnCode_t onExecute(RTC::UniqueId ec_id) override; // runs once per period while active
  RTC::ReturnCode_t onDeactivated(RTC::UniqueId ec_id) override;
  // Other callbacks: onFinalize, onStartup, onShutdown, onAborting, onError, onReset, onStateUpdate, onRateChanged.

 private:
  RTC::TimedDouble m_in, m_out;
  RTC::InPort<RTC::TimedDouble> m_inIn;
  RTC::OutPort<RTC::TimedDouble> m_outOut;
  double m_gain;
};

extern "C" void @NAME@Init(RTC::Manager* manager);

#endif
)";

// The specification is the list of keys and values that RTCBuilder writes. coil::Properties reads it up to "".
constexpr char rtc_source[] = R"(#include "@NAME@.h"

#include <iostream>

static const char* const specification[] = {
  "implementation_id", "@NAME@",
  "type_name", "@NAME@",
  "description", "Multiplies a number",
  "version", "1.0.0",
  "vendor", "me",
  "category", "Example",
  "activity_type", "PERIODIC",
  "kind", "DataFlowComponent",
  "max_instance", "0", // unlimited
  "language", "C++",
  "lang_type", "compile",
  "conf.default.gain", "2",
  ""
};

@NAME@::@NAME@(RTC::Manager* manager)
  : RTC::DataFlowComponentBase(manager), m_inIn("in", m_in), m_outOut("out", m_out), m_gain(1) {}

@NAME@::~@NAME@() {}

RTC::ReturnCode_t @NAME@::onInitialize() {
  addInPort("in", m_inIn);
  addOutPort("out", m_outOut);
  bindParameter("gain", m_gain, "2");
  return RTC::RTC_OK;
}

RTC::ReturnCode_t @NAME@::onActivated(RTC::UniqueId) {
  std::cout << getInstanceName() << ": activated, gain " << m_gain << std::endl;
  return RTC::RTC_OK;
}

RTC::ReturnCode_t @NAME@::onExecute(RTC::UniqueId) {
  if (m_inIn.isNew()) {
    m_inIn.read();
    m_out.tm = m_in.tm;
    m_out.data = m_gain * m_in.data;
    m_outOut.write();
  }
  return RTC::RTC_OK;
}

RTC::ReturnCode_t @NAME@::onDeactivated(RTC::UniqueId) { return RTC::RTC_OK; }

extern "C" void @NAME@Init(RTC::Manager* manager) {
  coil::Properties profile(specification);
  manager->registerFactory(profile, RTC::Create<@NAME@>, RTC::Delete<@NAME@>);
}
)";

// Uses nothing specific to Tandem, so that the folder also builds with OpenRTM-aist.
constexpr char rtc_build[] =
    R"(# With Tandem or OpenRTM-aist: cmake -S . -B build -DCMAKE_PREFIX_PATH=PREFIX && cmake --build build
cmake_minimum_required(VERSION 3.16)
project(@NAME@ CXX)
find_package(OpenRTM REQUIRED)

set(CMAKE_CXX_STANDARD 14)
add_library(@NAME@ MODULE @NAME@.cpp)
target_include_directories(@NAME@ PRIVATE ${OPENRTM_INCLUDE_DIRS})
target_compile_options(@NAME@ PRIVATE ${OPENRTM_CFLAGS})
target_link_directories(@NAME@ PRIVATE ${OPENRTM_LIBRARY_DIRS})
target_link_libraries(@NAME@ PRIVATE ${OPENRTM_LIBRARIES})
# The folder of rtc.conf is on the load path.
set_target_properties(@NAME@ PROPERTIES PREFIX "" LIBRARY_OUTPUT_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
)";

// For rtm_host -f. Connects the component to itself, so that it runs without a second component.
constexpr char conf[] = R"(manager.modules.load_path: .
manager.modules.preload: @NAME@.so
manager.components.precreate: @NAME@
# from?port=to; connects the component to itself
manager.components.preconnect: @NAME@0.out?port=@NAME@0.in
manager.components.preactivation: @NAME@0
manager.shutdown_auto: NO
exec_cxt.periodic.rate: 10
)";

/// Returns a component with an InPort, an OutPort and a parameter, an rtc.conf that runs it, and a CMakeLists.txt.
TemplateFiles rt_component_template(const std::string& name) {
    return {{name + ".h", expand_template(rtc_header, name)},
            {name + ".cpp", expand_template(rtc_source, name)},
            {"CMakeLists.txt", expand_template(rtc_build, name)},
            {"rtc.conf", expand_template(conf, name)}};
}

} // namespace

// The output contains the next two commands to copy.
int rtm_new(const std::string& name, const std::filesystem::path& parent) {
    require_component_name(name);
    const auto folder = parent / name;
    create_component_folder(folder, rt_component_template(name));
    const std::string shown = folder.lexically_normal().string();
    print_text(fmt::format("{0}: component {1} and an rtc.conf that runs it. Next:\n"
                           "  tandem rtm build {0}\n"
                           "  rtm_host -f {0}/rtc.conf\n",
                           shown, name));
    return 0;
}

} // namespace tandem::command
