// SPDX-License-Identifier: Apache-2.0
#ifndef PACKAGEUTIL_H_
#define PACKAGEUTIL_H_

#include <Component.h>

#include <string>

/// Returns the folder of the component's own files: res/ beside its profile, with '/' at the end. Valid from
/// onInitialize() on; empty in the constructor.
std::string opros_package_getResPath(Component* comp);

#define GetResourcePath() (opros_package_getResPath(this))

#endif
