// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plugins/devices/actuators/simulated_joint.hpp"
#include "plugins/devices/simulated_device.hpp"

#include <vector>

namespace tandem::devices {

/// An arm of `Size` joints, for the classes of arms.
template <typename Class>
class SimulatedArm : public SimulatedDevice<Class> {
  public:
    int Stop() override {
        return each([](SimulatedJoint& joint, std::size_t) { joint.stop(); });
    }
    int RunHoming() override {
        return each([](SimulatedJoint& joint, std::size_t) { joint.set_position(0, 0); });
    }
    int SetPower(std::vector<double> power, std::vector<unsigned long>) override {
        if (power.size() != joints_.size()) return API_ERROR;
        return each([&](SimulatedJoint& joint, std::size_t i) { joint.set_power(power[i]); });
    }
    int SetVelocity(std::vector<double> velocity, std::vector<unsigned long>) override {
        if (velocity.size() != joints_.size()) return API_ERROR;
        return each([&](SimulatedJoint& joint, std::size_t i) { joint.set_velocity(velocity[i]); });
    }
    int SetPosition(std::vector<double> position, std::vector<unsigned long> time) override {
        if (position.size() != joints_.size()) return API_ERROR;
        return each([&](SimulatedJoint& joint, std::size_t i) {
            joint.set_position(position[i], i < time.size() ? time[i] : 0);
        });
    }
    int GetPower(std::vector<double>& power) override {
        return read(power, [](const SimulatedJoint& joint) { return joint.power(); });
    }
    int GetVelocity(std::vector<double>& velocity) override {
        return read(velocity, [](const SimulatedJoint& joint) { return joint.velocity(); });
    }
    int GetPosition(std::vector<double>& position) override {
        return read(position, [](const SimulatedJoint& joint) { return joint.position(); });
    }

  protected:
    void configure() override {
        joints_.assign(static_cast<std::size_t>(this->count("Size", 6)), SimulatedJoint());
    }

  private:
    template <typename Act>
    int each(Act act) {
        return this->serve([&](double, double elapsed) {
            for (std::size_t i = 0; i < joints_.size(); ++i) {
                joints_[i].advance(elapsed);
                act(joints_[i], i);
            }
        });
    }
    template <typename Get>
    int read(std::vector<double>& values, Get get) {
        values.clear();
        return each([&](SimulatedJoint& joint, std::size_t) { values.push_back(get(joint)); });
    }

    std::vector<SimulatedJoint> joints_;
};

} // namespace tandem::devices
