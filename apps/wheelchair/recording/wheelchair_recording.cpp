// SPDX-License-Identifier: Apache-2.0
// The library that `wheelchair --record` loads.
#include "apps/tandem/record/lockstep_recording.hpp"
#include "apps/wheelchair/run/step_recording.hpp"

namespace tandem::wheelchair {
namespace {

class LinkRecording : public StepRecording {
  public:
    explicit LinkRecording(const std::string& file) : recording_(file) {}

    void begin(const std::vector<pid_t>& hosts, std::chrono::nanoseconds tick) override {
        recording_.begin(hosts, tick);
    }
    void record_step(std::uint64_t tick, const std::string& host, const std::string& component) override {
        recording_.record_step(tick, host, component);
    }
    std::string close() override {
        recording_.close();
        return recording_.summary();
    }

  private:
    command::LockstepRecording recording_;
};

} // namespace
} // namespace tandem::wheelchair

extern "C" tandem::wheelchair::StepRecording* tandem_make_step_recording(const std::string& file) {
    tandem::command::LockstepRecording::prepare_environment();
    return new tandem::wheelchair::LinkRecording(file);
}
