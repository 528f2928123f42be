// SPDX-License-Identifier: Apache-2.0
// Former name.
#ifndef COIL_STRINGUTIL_FORMER_H
#define COIL_STRINGUTIL_FORMER_H
#include <coil/stringutil.h>
#endif
