// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <device/OprosApi.h>

#include <catch2/catch.hpp>

#include <dlfcn.h>
#include <map>
#include <string>

/// A device from its library, as components get it: opened by a path, cast to its class. `Api` and `Parameters`: the
/// base class of devices and of properties in the component's version of OPRoS.
template <typename Class, typename Api = OprosApi, typename Parameters = Property>
class DeviceUnderTest {
  public:
    explicit DeviceUnderTest(const std::string& name, std::map<std::string, std::string> parameters = {}) {
        library_ = dlopen((DEVICES "/" + name + ".so").c_str(), RTLD_NOW);
        INFO(name);
        REQUIRE(library_);
        const auto get = reinterpret_cast<Api* (*)()>(dlsym(library_, "GetAPI"));
        REQUIRE(get);
        device_ = dynamic_cast<Class*>(get());
        REQUIRE(device_);
        parameters.emplace("TimeStep", "0.5");
        Parameters property;
        property.SetProperty(parameters);
        REQUIRE(device_->Initialize(property) == API_SUCCESS);
        REQUIRE(device_->Enable() == API_SUCCESS);
    }
    ~DeviceUnderTest() {
        delete device_;
        dlclose(library_);
    }
    Class* operator->() { return device_; }

  private:
    void* library_ = nullptr;
    Class* device_ = nullptr;
};

/// Loads the device as a component of OPRoS v2 does.
template <typename Class>
using DeviceOfV2 = DeviceUnderTest<Class, OprosDevice, OPRoS::Property>;
