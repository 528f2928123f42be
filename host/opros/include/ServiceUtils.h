// SPDX-License-Identifier: Apache-2.0
// Included by exactly one source file of each component library. It defines the library's getVersion().
#ifndef OPROS_SERVICE_UTILS_H
#define OPROS_SERVICE_UTILS_H

#include <EventCallBack.h>
#include <PackageUtil.h>
#include <SymbolService.h>

/// Returns the API version that this library was built with, for getVersion().
const char* get_opros_version();

#ifndef MAKE_STATIC_COMPONENT
extern "C" {
const char* getVersion() { return get_opros_version(); }
}
#endif

#endif
