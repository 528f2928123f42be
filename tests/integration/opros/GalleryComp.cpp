// SPDX-License-Identifier: Apache-2.0
// Sends back each picture that it receives, and prints their number.
#include "simple_component.h"

#include <iostream>
#include <memory>
#include <string>
#include <syncstream>
#include <vector>

/// As the RawImage.h that components carry: load() makes room for what width, height and pixelByte say, and reads as
/// many bytes as `size` says.
struct GalleryPicture {
    int width = 0, height = 0, pixelByte = 0;
    unsigned long size = 0;
    std::vector<char> room;

    void save(opros::archive::oarchive& ar, const unsigned int) {
        std::string raw("raw");
        ar << OPROS_SERIALIZATION_NVP(raw) << OPROS_SERIALIZATION_NVP(width)
           << OPROS_SERIALIZATION_NVP(height) << OPROS_SERIALIZATION_NVP(pixelByte)
           << OPROS_SERIALIZATION_NVP(size);
        ar.save(room.data(), static_cast<long>(size));
    }
    void load(opros::archive::iarchive& ar, const unsigned int) {
        std::string raw;
        ar >> OPROS_SERIALIZATION_NVP(raw) >> OPROS_SERIALIZATION_NVP(width) >>
            OPROS_SERIALIZATION_NVP(height) >> OPROS_SERIALIZATION_NVP(pixelByte) >>
            OPROS_SERIALIZATION_NVP(size);
        room.resize(static_cast<std::size_t>(width) * height * pixelByte +
                    1); // of its own, even for no bytes
        char* bytes = room.data();
        ar.load(&bytes, size);
    }
};
std::string typeName(GalleryPicture*) { return "RawImage"; }

class GalleryComp : public SimpleComponent {
  public:
    GalleryComp() {
        addPort("camera", &camera_);
        addPort("shown", &shown_);
    }
    ReturnType onExecute() override {
        while (const std::unique_ptr<opros_any> value{camera_.pop()}) {
            const GalleryPicture& picture = camera_.getContent(*value);
            ++count_;
            sum_ += static_cast<long>(picture.size);
            if (picture.width == 1 && picture.height == 2) // the last one
                std::osyncstream(std::cout)
                    << "GalleryComp: " << count_ << " pictures of " << sum_ << " bytes" << std::endl;
            shown_.push(picture);
        }
        return OPROS_SUCCESS;
    }

  private:
    InputDataPort<GalleryPicture> camera_{OPROS_UFIFO, 100};
    OutputDataPort<GalleryPicture> shown_;
    long count_ = 0, sum_ = 0;
};

extern "C" {
Component* getComponent() { return new GalleryComp; }
void releaseComponent(Component* component) { delete component; }
}
