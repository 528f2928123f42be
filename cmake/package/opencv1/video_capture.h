// SPDX-License-Identifier: Apache-2.0
// Cameras and video files of OpenCV 1 and 2. OpenCV 4 still declares these functions, but they open nothing. This header
// implements them with cv::VideoCapture and cv::VideoWriter. Macros give them other names, because the library has the
// original ones.
#ifndef TANDEM_OPENCV1_VIDEO_CAPTURE_H
#define TANDEM_OPENCV1_VIDEO_CAPTURE_H

#include <cxcore.h>
#include <opencv2/videoio.hpp>
#include <opencv2/videoio/videoio_c.h>

#include <string>

struct TandemCvCapture {
    cv::VideoCapture stream;
    cv::Mat pixels;
    IplImage frame; // over the pixels
};

struct TandemCvVideoWriter {
    cv::VideoWriter stream;
};

#undef cvCaptureFromFile
#undef cvCaptureFromAVI
#undef cvCaptureFromCAM
#undef cvCreateAVIWriter
#undef cvWriteToAVI
#define CvCapture TandemCvCapture
#define CvVideoWriter TandemCvVideoWriter
#define cvCreateFileCapture tandem_cvCreateFileCapture
#define cvCaptureFromFile tandem_cvCreateFileCapture
#define cvCaptureFromAVI tandem_cvCreateFileCapture
#define cvCreateCameraCapture tandem_cvCreateCameraCapture
#define cvCaptureFromCAM tandem_cvCreateCameraCapture
#define cvGrabFrame tandem_cvGrabFrame
#define cvRetrieveFrame tandem_cvRetrieveFrame
#define cvQueryFrame tandem_cvQueryFrame
#define cvGetCaptureProperty tandem_cvGetCaptureProperty
#define cvSetCaptureProperty tandem_cvSetCaptureProperty
#define cvReleaseCapture tandem_cvReleaseCapture
#define cvCreateVideoWriter tandem_cvCreateVideoWriter
#define cvCreateAVIWriter tandem_cvCreateVideoWriter
#define cvWriteFrame tandem_cvWriteFrame
#define cvWriteToAVI tandem_cvWriteFrame
#define cvReleaseVideoWriter tandem_cvReleaseVideoWriter

/// Returns NULL if the file or device cannot be opened, even if OpenCV throws.
template <class Source>
TandemCvCapture* tandem_open_capture(const Source& source) {
    TandemCvCapture* capture = new TandemCvCapture;
    try {
        if (capture->stream.open(source)) return capture;
    } catch (const cv::Exception&) {
    }
    delete capture;
    return NULL;
}
inline TandemCvCapture* tandem_cvCreateFileCapture(const char* file) {
    return file ? tandem_open_capture(std::string(file)) : NULL;
}
inline TandemCvCapture* tandem_cvCreateCameraCapture(int index) {
    return tandem_open_capture(index < 0 ? 0 : index); // -1: any
}
inline int tandem_cvGrabFrame(TandemCvCapture* capture) { return capture && capture->stream.grab() ? 1 : 0; }
/// Returns the picture, which is valid until the next call; NULL at the end. The capture owns it.
inline IplImage* tandem_cvRetrieveFrame(TandemCvCapture* capture, int channel = 0) {
    if (!capture || !capture->stream.retrieve(capture->pixels, channel)) return NULL;
    capture->frame = cvIplImage(capture->pixels);
    return &capture->frame;
}
inline IplImage* tandem_cvQueryFrame(TandemCvCapture* capture) {
    return tandem_cvGrabFrame(capture) ? tandem_cvRetrieveFrame(capture) : NULL;
}
inline double tandem_cvGetCaptureProperty(TandemCvCapture* capture, int property) {
    return capture ? capture->stream.get(property) : 0;
}
inline int tandem_cvSetCaptureProperty(TandemCvCapture* capture, int property, double value) {
    return capture && capture->stream.set(property, value) ? 1 : 0;
}
inline void tandem_cvReleaseCapture(TandemCvCapture** capture) {
    if (!capture) return;
    delete *capture;
    *capture = NULL;
}

/// Returns NULL if the file cannot be written in this format.
inline TandemCvVideoWriter* tandem_cvCreateVideoWriter(const char* file, int code, double rate, CvSize size,
                                                       int is_color = 1) {
    TandemCvVideoWriter* writer = new TandemCvVideoWriter;
    try {
        if (file && writer->stream.open(file, code, rate, cv::Size(size.width, size.height), is_color != 0))
            return writer;
    } catch (const cv::Exception&) {
    }
    delete writer;
    return NULL;
}
inline int tandem_cvWriteFrame(TandemCvVideoWriter* writer, const IplImage* image) {
    if (!writer || !image) return 0;
    writer->stream.write(cv::cvarrToMat(image));
    return 1;
}
inline void tandem_cvReleaseVideoWriter(TandemCvVideoWriter** writer) {
    if (!writer) return;
    delete *writer;
    *writer = NULL;
}

#endif
