// SPDX-License-Identifier: Apache-2.0
// The header of OpenCV 1 and 2 of this name. It includes the part of their C API that OpenCV 4 still has, and those C++ modules
// of OpenCV 2's cv.h that are installed.
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
