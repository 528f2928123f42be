// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/interceptor_comp.hpp"

#include <tandem_version.hpp>

namespace {
const char* const specification[] = {"implementation_id",
                                     "InterceptorComp",
                                     "type_name",
                                     "InterceptorComp",
                                     "description",
                                     "the RTM side of Tandem's proxy",
                                     "version",
                                     tandem::version,
                                     "vendor",
                                     "Tandem",
                                     "category",
                                     "proxy",
                                     "activity_type",
                                     "PERIODIC",
                                     "kind",
                                     "DataFlowComponent",
                                     "max_instance",
                                     "0",
                                     "language",
                                     "C++",
                                     "lang_type",
                                     "compile",
                                     ""};
}

// What an RTM manager looks up in a module: the library's name followed by Init.
extern "C" void InterceptorCompInit(RTC::Manager* manager) {
    coil::Properties profile(specification);
    manager->registerFactory(profile, RTC::Create<tandem::interceptor::InterceptorComp>,
                             RTC::Delete<tandem::interceptor::InterceptorComp>);
}
