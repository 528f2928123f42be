// SPDX-License-Identifier: Apache-2.0
// The header of OpenCV 1 and 2 of this name, over the C API that OpenCV 4 has.
#ifndef TANDEM_OPENCV1_CXCORE_H
#define TANDEM_OPENCV1_CXCORE_H

#ifdef __cplusplus
#include <opencv2/core.hpp>
#endif
#include <opencv2/core/core_c.h>

#endif
