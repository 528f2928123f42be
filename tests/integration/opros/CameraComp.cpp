// SPDX-License-Identifier: Apache-2.0
// Sends pictures of several sizes in turn, one at a time, and prints how each came back.
#include "simple_component.h"

#include <OPRoSInclude.h>

#include <iostream>
#include <memory>
#include <syncstream>

class CameraComp : public SimpleComponent {
  public:
    CameraComp() {
        addPort("picture", &picture_);
        addPort("pictureBack", &back_);
    }

    ReturnType onExecute() override {
        while (const std::unique_ptr<opros_any> any{back_.pop()}) look_at(*back_.getContentPointer(*any));
        if (taken_ == returned_ || ++cycles_ == max_wait_cycles) take();
        return OPROS_SUCCESS;
    }

  private:
    using Picture = std::vector<unsigned char>;

    void take() {
        static const std::size_t sizes[] = {1 << 20, 6 << 20, 640 * 480 * 3, 100, 64 << 20};
        ++taken_;
        cycles_ = 0;
        last_.resize(sizes[taken_ % 5]);
        for (std::size_t i = 0; i < last_.size(); ++i)
            last_[i] = static_cast<unsigned char>(taken_ * 31 + i / 7);
        picture_.push(last_);
    }
    void look_at(const Picture& back) {
        if (back.size() != last_.size()) return; // of one that was given up
        returned_ = taken_;
        std::osyncstream(std::cout) << "picture of " << back.size() << " bytes came back "
                                    << (back == last_ ? "whole" : "broken") << std::endl;
    }

    static constexpr int max_wait_cycles = 100; // cycles, for a picture that is lost while there is no peer
    int cycles_ = 0;
    std::size_t taken_ = 0, returned_ = 0;
    Picture last_;
    OutputDataPort<Picture> picture_;
    InputDataPort<Picture> back_;
};

extern "C" {
Component* getComponent() { return new CameraComp; }
void releaseComponent(Component* component) { delete component; }
}
