// SPDX-License-Identifier: Apache-2.0
// The function by which a host of either model enters a plugin: ZOO_ENTRY { ...; return ZOO_RESULT; }
#pragma once

#ifdef ZOO_INIT // as an RTC module: its name
namespace RTC {
class Manager;
}
#define ZOO_ENTRY extern "C" void ZOO_INIT(RTC::Manager*)
#define ZOO_RESULT
#else
class Component;
#define ZOO_ENTRY extern "C" Component* getComponent()
#define ZOO_RESULT nullptr
#endif
