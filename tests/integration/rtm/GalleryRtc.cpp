// SPDX-License-Identifier: Apache-2.0
// Sends the pictures of many cameras, each with any `bpp`, one in each cycle, and prints the answers.
#include "register_rtc.hpp"
#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/idl/InterfaceDataTypesSkel.h>

#include <iostream>
#include <limits>
#include <string>
#include <syncstream>

namespace {

struct GalleryCamera {
    CORBA::UShort width, height;
    const char* format;
    CORBA::ULong bytes;
};

// The first fourteen are pictures. The others have bytes that are not pixels, or no bytes.
constexpr GalleryCamera gallery_cameras[] = {
    {320, 240, "", 320 * 240 * 3},
    {320, 240, "", 320 * 240},
    {64, 48, "bitmap", 64 * 48 * 3},
    {64, 48, "RGB8", 64 * 48 * 3},
    {64, 48, "BGRA", 64 * 48 * 4},
    {64, 48, "YUYV", 64 * 48 * 2},
    {64, 48, "BAYER", 64 * 48},
    {64, 48, "depth", 64 * 48 * 2},
    {64, 48, "", 64 * 48 * 12},
    {1, 1, "", 3},
    {64, 1, "", 64},
    {65535, 1, "", 65535},
    {33, 24, "", 33 * 24 * 3},
    {0, 0, "", 0},
    {64, 48, "I420", 64 * 48 * 3 / 2},
    {64, 48, "", 64 * 48 / 8},
    {33, 24, "", 100 * 24},
    {32, 24, "", 64 * 48 * 3 + 1},
    {64, 48, "jpeg", 1021},
    {64, 48, "JPEG", 64 * 48},
    {64, 48, "image/png", 64 * 48 * 3},
    {64, 48, "", 1021},
    {64, 48, "", 0},
    {0, 0, "", 64 * 48 * 3},
    {64, 0, "", 64},
};
constexpr CORBA::UShort gallery_bits[] = {0, 1, 3, 8, 16, 24, 32, 22015};

} // namespace

class GalleryRtc : public RTC::DataFlowComponentBase {
  public:
    explicit GalleryRtc(RTC::Manager* manager)
        : RTC::DataFlowComponentBase(manager), cameraOut_("camera", camera_), shownIn_("shown", shown_) {}

    RTC::ReturnCode_t onInitialize() override {
        addOutPort("camera", cameraOut_);
        addInPort("shown", shownIn_);
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        constexpr std::size_t cameras = std::size(gallery_cameras), all = cameras * std::size(gallery_bits);
        if (next_ < all) send(gallery_cameras[next_ % cameras], gallery_bits[next_ / cameras]);
        if (next_ == all) send({1, 2, "", 2}, 0);
        ++next_;
        while (shownIn_.isNew()) {
            shownIn_.read();
            ++count_;
            wrong_ += shown_.width * shown_.height * (shown_.bpp / 8U) != shown_.pixels.length();
            if (shown_.width == 1 && shown_.height == 2)
                std::osyncstream(std::cout)
                    << "GalleryRtc: " << count_ << " pictures, " << wrong_ << " of other sizes" << std::endl;
        }
        return RTC::RTC_OK;
    }

  private:
    void send(const GalleryCamera& camera, CORBA::UShort bpp) {
        camera_.width = camera.width;
        camera_.height = camera.height;
        camera_.bpp = bpp;
        camera_.format = camera.format;
        camera_.fDiv = std::numeric_limits<double>::quiet_NaN();
        camera_.pixels.length(camera.bytes);
        cameraOut_.write();
    }

    RTC::CameraImage camera_{}, shown_{};
    RTC::OutPort<RTC::CameraImage> cameraOut_;
    RTC::InPort<RTC::CameraImage> shownIn_;
    std::size_t next_ = 0;
    long count_ = 0, wrong_ = 0;
};

extern "C" void GalleryRtcInit(RTC::Manager* manager) { register_rtc<GalleryRtc>(manager, "GalleryRtc"); }
