// SPDX-License-Identifier: Apache-2.0
// The header of OpenCV 1 and 2 of this name, over what OpenCV 4 has of their C API. What is missing in OpenCV 4 is missing
// here. The C++ modules that cv.h of OpenCV 2 included come along, as far as they are installed.
#ifndef TANDEM_OPENCV1_CV_H
#define TANDEM_OPENCV1_CV_H

#include <cxcore.h>
#include <opencv2/imgproc/imgproc_c.h>

#ifdef __cplusplus
#include <opencv2/imgproc.hpp>
// A colour for the functions in C, which do not take OpenCV 4's cv::Scalar; it becomes one where that is wanted.
#undef CV_RGB
#define CV_RGB(r, g, b) cvScalar((b), (g), (r), 0)
#if __has_include(<opencv2/calib3d/calib3d_c.h>)
#include <opencv2/calib3d/calib3d_c.h>
#endif
#if __has_include(<opencv2/calib3d.hpp>)
#include <opencv2/calib3d.hpp>
#endif
#if __has_include(<opencv2/features2d.hpp>)
#include <opencv2/features2d.hpp>
#endif
#if __has_include(<opencv2/objdetect.hpp>)
#include <opencv2/objdetect.hpp>
#endif
#if __has_include(<opencv2/video.hpp>)
#include <opencv2/video.hpp>
#include <opencv2/video/legacy/constants_c.h>
#endif
#endif

#endif
