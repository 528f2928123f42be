// SPDX-License-Identifier: Apache-2.0
// Factories of what component libraries may bring along.
#include <rtm/ExecutionContextBase.h>
#include <rtm/LogstreamBase.h>
#include <rtm/SdoServiceConsumerBase.h>
#include <rtm/SdoServiceProviderBase.h>

template class coil::GlobalFactory<RTC::ExecutionContextBase>;
template class coil::GlobalFactory<RTC::LogstreamBase>;
template class coil::GlobalFactory<RTC::SdoServiceConsumerBase>;
template class coil::GlobalFactory<RTC::SdoServiceProviderBase>;
