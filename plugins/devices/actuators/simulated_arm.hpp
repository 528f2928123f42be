// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plugins/devices/actuators/simulated_joint.hpp"
#include "plugins/devices/simulated_device.hpp"

#include <vector>

namespace tandem::devices {

/// An arm with `Size` joints (default 6), for the device classes Manipulator and Gripper. Lists have one entry for each
/// joint; lists of another length cause API_ERROR.
template <typename Class>
class SimulatedArm : public SimulatedDevice<Class> {
  public:
    int Stop() override {
        return for_each_joint([](SimulatedJoint& joint, std::size_t) { joint.stop(); });
    }
    /// Moves all joints to position 0 at once.
    int RunHoming() override {
        return for_each_joint([](SimulatedJoint& joint, std::size_t) { joint.set_position(0, 0); });
    }
    int SetPower(std::vector<double> power, std::vector<unsigned long>) override {
        if (power.size() != joints_.size()) return API_ERROR;
        return for_each_joint([&](SimulatedJoint& joint, std::size_t i) { joint.set_power(power[i]); });
    }
    int SetVelocity(std::vector<double> velocity, std::vector<unsigned long>) override {
        if (velocity.size() != joints_.size()) return API_ERROR;
        return for_each_joint([&](SimulatedJoint& joint, std::size_t i) { joint.set_velocity(velocity[i]); });
    }
    /// Moves joints without a time at once.
    int SetPosition(std::vector<double> position, std::vector<unsigned long> time) override {
        if (position.size() != joints_.size()) return API_ERROR;
        return for_each_joint([&](SimulatedJoint& joint, std::size_t i) {
            joint.set_position(position[i], i < time.size() ? time[i] : 0);
        });
    }
    int GetPower(std::vector<double>& power) override {
        return collect(power, [](const SimulatedJoint& joint) { return joint.power(); });
    }
    int GetVelocity(std::vector<double>& velocity) override {
        return collect(velocity, [](const SimulatedJoint& joint) { return joint.velocity(); });
    }
    int GetPosition(std::vector<double>& position) override {
        return collect(position, [](const SimulatedJoint& joint) { return joint.position(); });
    }

  protected:
    void configure() override {
        joints_.assign(static_cast<std::size_t>(this->count_parameter("Size", 6)), SimulatedJoint());
    }

  private:
    /// Advances all joints to the current time and calls action(joint, index) for each.
    template <typename Action>
    int for_each_joint(Action action) {
        return this->perform([&](double, double elapsed) {
            for (std::size_t i = 0; i < joints_.size(); ++i) {
                joints_[i].advance(elapsed);
                action(joints_[i], i);
            }
        });
    }
    /// Returns one value per joint.
    template <typename Get>
    int collect(std::vector<double>& values, Get get) {
        values.clear();
        return for_each_joint([&](SimulatedJoint& joint, std::size_t) { values.push_back(get(joint)); });
    }

    std::vector<SimulatedJoint> joints_;
};

} // namespace tandem::devices
