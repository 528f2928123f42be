// SPDX-License-Identifier: Apache-2.0
// The process-wide factories of kinds of objects that component libraries may bring along, as OpenRTM-aist's
// coil::GlobalFactory singletons. Instantiated here and nowhere else: each library having its own copy would
// mean that the host does not see what a library registers.
#include <rtm/ExecutionContextBase.h>
#include <rtm/LogstreamBase.h>
#include <rtm/SdoServiceConsumerBase.h>
#include <rtm/SdoServiceProviderBase.h>

template class coil::GlobalFactory<RTC::ExecutionContextBase>;
template class coil::GlobalFactory<RTC::LogstreamBase>;
template class coil::GlobalFactory<RTC::SdoServiceConsumerBase>;
template class coil::GlobalFactory<RTC::SdoServiceProviderBase>;
