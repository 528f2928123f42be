// SPDX-License-Identifier: Apache-2.0
// The header's name in OpenRTM-aist 1.x.
#ifndef COIL_STRINGUTIL_FORMER_H
#define COIL_STRINGUTIL_FORMER_H
#include <coil/stringutil.h>
#endif
