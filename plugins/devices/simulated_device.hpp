// SPDX-License-Identifier: Apache-2.0
// What all simulated devices have in common.
#pragma once

#include <device/OprosApi.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <mutex>
#include <string>

namespace tandem::devices {

/// A device of one class of the device API, without hardware. It works from Initialize() to Finalize(). Its
/// time runs with the clock, or by the parameter `TimeStep` (seconds) per call, which makes every run the
/// same. [any-thread]: components read a device in their executor and in the threads that call their
/// services.
template <typename Class>
class SimulatedDevice : public Class {
  public:
    int Initialize(Property parameters) override {
        const std::lock_guard<std::mutex> lock(mutex_);
        parameters_ = parameters;
        step_ = number("TimeStep", 0);
        seconds_ = 0;
        last_call_ = std::chrono::steady_clock::now();
        initialized_ = true;
        configure();
        return API_SUCCESS;
    }
    int Finalize() override {
        const std::lock_guard<std::mutex> lock(mutex_);
        initialized_ = false;
        return API_SUCCESS;
    }
    int Enable() override { return working(); }
    int Disable() override { return working(); }
    int OnExecute() override { return working(); }
    int SetParameter(Property parameters) override {
        const std::lock_guard<std::mutex> lock(mutex_);
        parameters_ = parameters;
        return API_SUCCESS;
    }
    int GetParameter(Property& parameters) override {
        const std::lock_guard<std::mutex> lock(mutex_);
        parameters = parameters_;
        return API_SUCCESS;
    }

  protected:
    /// Takes what the device needs from its parameters; the lock is held.
    virtual void configure() {}

    /// Calls `act(seconds since Initialize(), seconds since the last call)` with the lock held.
    template <typename Act>
    int serve(Act act) {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (!initialized_) return API_ERROR;
        const auto now = std::chrono::steady_clock::now();
        const double elapsed = step_ > 0 ? step_ : std::chrono::duration<double>(now - last_call_).count();
        last_call_ = now;
        seconds_ += elapsed;
        act(seconds_, elapsed);
        return API_SUCCESS;
    }

    double number(const char* name, double otherwise) {
        return parameters_.FindName(name) ? std::strtod(parameters_.GetValue(name).c_str(), nullptr)
                                          : otherwise;
    }
    /// A number of things: from 1 to 100,000.
    int count(const char* name, int otherwise) {
        const double given = number(name, otherwise);
        return given >= 1 && given <= 1e5 ? static_cast<int>(given) : otherwise;
    }

  private:
    int working() {
        const std::lock_guard<std::mutex> lock(mutex_);
        return initialized_ ? API_SUCCESS : API_ERROR;
    }

    std::mutex mutex_;
    Property parameters_;
    bool initialized_ = false;
    double step_ = 0, seconds_ = 0;
    std::chrono::steady_clock::time_point last_call_;
};

} // namespace tandem::devices

/// The two functions by which a component gets the device from its library, and may give it back.
#define TANDEM_DEVICE(type)                                                                                  \
    extern "C" OprosApi* GetAPI() { return new type; }                                                       \
    extern "C" void ReleaseAPI(OprosApi* device) { delete device; }
