// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/tandem/scale/cells.hpp"

#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataInPort.h>
#include <rtm/DataOutPort.h>
#include <rtm/Manager.h>
#include <rtm/idl/BasicDataTypeSkel.h>

#include <string>

namespace {

class BenchCell : public RTC::DataFlowComponentBase {
  public:
    explicit BenchCell(RTC::Manager* manager) : DataFlowComponentBase(manager) {}
    RTC::ReturnCode_t onInitialize() override {
        addInPort("in", in_);
        addOutPort("out", out_);
        sends_ = std::string(getInstanceName()) == "BenchCell0" && tandem::bench::Cells::all().data_moves();
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        record_.cycle();
        const bool is_new = in_.isNew();
        if (is_new) in_.read();
        output_.data = sends_ ? output_.data + 1 : input_.data;
        if (is_new || sends_) out_.write();
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onDeactivated(RTC::UniqueId) override {
        record_.end();
        return RTC::RTC_OK;
    }

  private:
    RTC::TimedLong input_{}, output_{};
    RTC::InPort<RTC::TimedLong> in_{"in", input_};
    RTC::OutPort<RTC::TimedLong> out_{"out", output_};
    bool sends_ = false;
    tandem::bench::CellRecord record_;
};

} // namespace

extern "C" void BenchCellRtcInit(RTC::Manager* manager) {
    coil::Properties profile;
    for (const char* key : {"implementation_id", "type_name"}) profile.setProperty(key, "BenchCell");
    manager->registerFactory(profile, RTC::Create<BenchCell>, RTC::Delete<BenchCell>);
}
