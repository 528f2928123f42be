// SPDX-License-Identifier: Apache-2.0
// The header of OpenCV 1 and 2 of this name. It includes the part of their C API that OpenCV 4 still has, and implements the
// missing functions for image files with cv::imread() and cv::imwrite().
#ifndef TANDEM_OPENCV1_HIGHGUI_H
#define TANDEM_OPENCV1_HIGHGUI_H

#include <cxcore.h>
#include <opencv2/highgui/highgui_c.h>
#include <opencv2/imgcodecs/legacy/constants_c.h>
#include <opencv2/imgproc/imgproc_c.h>

#ifdef __cplusplus
#include "video_capture.h"
#include <opencv2/highgui.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#define CV_CVTIMG_FLIP 1
#define CV_CVTIMG_SWAP_RB 2

/// Returns a new image for cvReleaseImage(); NULL if the file cannot be read.
inline IplImage* cvLoadImage(const char* file, int flags = CV_LOAD_IMAGE_COLOR) {
    const cv::Mat pixels = cv::imread(file, flags);
    if (pixels.empty()) return NULL;
    const IplImage view = cvIplImage(pixels);
    return cvCloneImage(&view);
}

/// Returns 1 if the file was written, otherwise 0. `parameters` as for cv::imwrite(), with a 0 after the last pair.
inline int cvSaveImage(const char* file, const CvArr* image, const int* parameters = NULL) {
    std::vector<int> all;
    for (; parameters && *parameters; parameters += 2) all.insert(all.end(), parameters, parameters + 2);
    try {
        return cv::imwrite(file, cv::cvarrToMat(image), all) ? 1 : 0;
    } catch (const cv::Exception&) { // an ending that names no format
        return 0;
    }
}

/// Copies an image of 8 bits into one of the same size with 1 or 3 channels. CV_CVTIMG_FLIP turns it upside down, and
/// CV_CVTIMG_SWAP_RB exchanges red and blue.
inline void cvConvertImage(const CvArr* source, CvArr* target, int flags = 0) {
    const cv::Mat from = cv::cvarrToMat(source);
    cv::Mat to = cv::cvarrToMat(target), changed = from;
    if (from.channels() == 1 && to.channels() == 3)
        cv::cvtColor(from, changed, cv::COLOR_GRAY2BGR);
    else if (from.channels() == 3 && to.channels() == 1)
        cv::cvtColor(from, changed, flags & CV_CVTIMG_SWAP_RB ? cv::COLOR_RGB2GRAY : cv::COLOR_BGR2GRAY);
    else if (from.channels() == 3 && (flags & CV_CVTIMG_SWAP_RB))
        cv::cvtColor(from, changed, cv::COLOR_BGR2RGB);
    if (flags & CV_CVTIMG_FLIP)
        cv::flip(changed, to, 0);
    else
        changed.copyTo(to);
}
#else
#include <opencv2/videoio/videoio_c.h>
#endif

#endif
