// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/tandem/scale/cells.hpp"

#include <Component.h>
#include <InputDataPort.h>
#include <OutputDataPort.h>

#include <memory>

namespace {

class BenchCellComp : public Component {
  public:
    BenchCellComp() : in_(OPROS_LAST, 1) {
        addPort("in", &in_);
        addPort("out", &out_);
    }
    ReturnType onInitialize() override { return OPROS_SUCCESS; }
    ReturnType onDestroy() override { return OPROS_SUCCESS; }
    ReturnType onStart() override {
        sends_ = getId() == "BenchCell0" && tandem::bench::Cells::all().data_moves();
        return OPROS_SUCCESS;
    }
    ReturnType onExecute() override {
        record_.cycle();
        const std::unique_ptr<opros_any> value(in_.pop());
        if (sends_)
            out_.push(++sent_);
        else if (value)
            out_.push(in_.getContent(*value));
        return OPROS_SUCCESS;
    }
    ReturnType onStop() override {
        record_.end();
        return OPROS_SUCCESS;
    }

  private:
    InputDataPort<int> in_;
    OutputDataPort<int> out_;
    bool sends_ = false;
    int sent_ = 0;
    tandem::bench::CellRecord record_;
};

} // namespace

extern "C" {
Component* getComponent() { return new BenchCellComp; }
void releaseComponent(Component* component) { delete component; }
}
