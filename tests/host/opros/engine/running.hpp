// SPDX-License-Identifier: Apache-2.0
// An application made for one test, and what its components have recorded.
#pragma once

#include "host/opros/engine/application.hpp"
#include "tests/host/opros/engine/folder.hpp"
#include "tests/host/opros/fixtures/Recorder.h"

#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

inline tandem::engine::ApplicationOptions test_options(const Folder& folder, bool lockstep = true) {
    tandem::engine::ApplicationOptions options;
    options.plugin_dirs = {FIXTURES};
    if (lockstep) options.lockstep_socket = folder.path() / "step";
    return options;
}

inline Recorder& recorder(tandem::engine::Application& application, const std::string& name) {
    auto* component = application.find_component(name);
    REQUIRE(component);
    return dynamic_cast<Recorder&>(component->component());
}

inline LifecycleState state(tandem::engine::Application& application, const std::string& name) {
    return application.find_component(name)->component().getStatus();
}

/// Waits for something that other threads bring about; false only when the machine is stuck.
template <class Condition>
bool eventually(Condition condition) {
    for (int i = 0; i < 20000; ++i) {
        if (condition()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
}

/// The message of the SetupError that making the application, strictly, ends in.
inline std::string setup_error(const std::filesystem::path& file,
                               tandem::engine::ApplicationOptions options) {
    options.strict = true;
    options.grace = std::chrono::hours(1); // nothing runs yet that the end could wait for
    try {
        tandem::engine::Application application(file, options);
    } catch (const tandem::engine::SetupError& error) {
        return error.what();
    }
    return "no error";
}
