// SPDX-License-Identifier: Apache-2.0
// A former name.
#ifndef RTM_STRINGUTIL_H
#define RTM_STRINGUTIL_H
#include <coil/stringutil.h>
#endif
