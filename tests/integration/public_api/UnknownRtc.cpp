// SPDX-License-Identifier: Apache-2.0
// EchoRtc as it is without Tandem's IDL compiler: its host does not know the operations of its service.
#define EchoRtcInit echo_rtc_init
#include "../rtm/EchoRtc.cpp"

#include "DictionaryDynSK.cc"
#include "DictionarySK.cc"

extern "C" void UnknownRtcInit(RTC::Manager* manager) { register_rtc<EchoRtc>(manager, "UnknownRtc"); }
