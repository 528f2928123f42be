// SPDX-License-Identifier: Apache-2.0
// The base class of all simulated devices.
#pragma once

#include <device/OprosApi.h>

#include <chrono>
#include <cmath>
#include <locale>
#include <mutex>
#include <sstream>
#include <string>
#include <type_traits>

namespace tandem::devices {

/// A device of the OPRoS device class `Class` without hardware. Before Initialize() and after Finalize(), its functions
/// return API_ERROR. Its time is that of the clock, or advances by the parameter `TimeStep` (s) per call, which makes
/// runs reproducible. [any-thread], because components use a device in their executor and in the threads that call
/// their services.
template <typename Class>
class SimulatedDevice : public Class {
  public:
    using Class::Initialize;
    int Initialize(Property parameters) override {
        const std::lock_guard<std::mutex> lock(mutex_);
        parameters_ = parameters;
        time_step_ = number_parameter("TimeStep", 0);
        time_ = 0;
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
    int Enable() override { return status(); }
    int Disable() override { return status(); }
    int OnExecute() override { return status(); }
    /// Only stores the parameters for GetParameter(). Initialize() receives its own.
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
    /// Resets the device and reads its parameters. Called by Initialize() with the lock held.
    virtual void configure() {}

    /// Performs a function of a device class. If the device is initialized, advances the time and calls action() or
    /// action(time, elapsed) with the lock held: seconds since Initialize(), and since the last call. Returns
    /// API_SUCCESS, or API_ERROR if the device is not initialized.
    template <typename Action>
    int perform(Action action) {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (!initialized_) return API_ERROR;
        const double elapsed = advance_time();
        if constexpr (std::is_invocable_v<Action>)
            action();
        else
            action(time_, elapsed);
        return API_SUCCESS;
    }

    /// Calls perform() with an assignment as the action.
    template <typename Value>
    int copy(const Value& from, Value& to) {
        return perform([&] { to = from; });
    }

    /// Returns a parameter as a number; 0 if it is not a number. If it does not exist, returns the default and keeps it
    /// for GetParameter(), because components ask the device for the size of its data. [in configure()]
    double number_parameter(const std::string& name, double default_value) {
        std::stringstream text;
        text.imbue(std::locale::classic()); // a component may have set another locale
        if (!parameters_.FindName(name)) {
            text << default_value;
            parameters_.SetValue(name, text.str());
            return default_value;
        }
        text.str(parameters_.GetValue(name));
        double value = 0;
        text >> value;
        return value;
    }
    /// Returns a count from 1 to 100,000, because memory is allocated for it; the default for other numbers. [in
    /// configure()]
    int count_parameter(const std::string& name, int default_value) {
        const double given = number_parameter(name, default_value);
        return given >= 1 && given <= 1e5 ? static_cast<int>(given) : default_value;
    }

  private:
    int status() {
        const std::lock_guard<std::mutex> lock(mutex_);
        return initialized_ ? API_SUCCESS : API_ERROR;
    }
    double advance_time() {
        const auto now = std::chrono::steady_clock::now();
        const double elapsed =
            time_step_ > 0 ? time_step_ : std::chrono::duration<double>(now - last_call_).count();
        last_call_ = now;
        time_ += elapsed;
        return elapsed;
    }

    std::mutex mutex_; // guards all members, including those of derived classes
    Property parameters_;
    bool initialized_ = false;
    double time_step_ = 0, time_ = 0; // s
    std::chrono::steady_clock::time_point last_call_;
};

} // namespace tandem::devices

/// Creates a device of the class (which may contain commas) for the library `name` (entry_points.cpp).
#define TANDEM_DEVICE(name, ...)                                                                             \
    namespace tandem::devices {                                                                              \
    OprosApi* new_##name() { return new __VA_ARGS__; }                                                       \
    }
