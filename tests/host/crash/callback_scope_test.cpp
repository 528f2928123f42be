// SPDX-License-Identifier: Apache-2.0
#include "host/crash/callback_scope.hpp"

#include <catch2/catch.hpp>

#include <future>
#include <string>
#include <thread>

using tandem::crash::CallbackScope;
using tandem::crash::find_running_callback;

namespace {
// The address of any object can stand for a component.
std::string running_in(const int& component) {
    const auto found = find_running_callback(&component);
    return found ? found->name : "none";
}
} // namespace

TEST_CASE("the callback of a component is known in every thread while it runs") {
    const int camera = 0, arm = 0;
    std::promise<void> entered, end;
    std::thread thread([&] {
        const CallbackScope scope(&camera, "camera", "onActivated", nullptr);
        entered.set_value();
        end.get_future().wait();
    });
    entered.get_future().wait();
    CHECK(running_in(camera) == "onActivated");
    CHECK(running_in(arm) == "none");
    end.set_value();
    thread.join();
    CHECK(running_in(camera) == "none");
}

TEST_CASE(
    "of nested callbacks, the component's innermost one is known, even if it has called another component") {
    const int camera = 0, arm = 0;
    const CallbackScope outer(&camera, "camera", "onExecute", nullptr);
    {
        const CallbackScope inner(&camera, "camera", "onEvent", nullptr);
        const CallbackScope called(&arm, "arm", "move", nullptr);
        CHECK(running_in(camera) == "onEvent");
        CHECK(running_in(arm) == "move");
    }
    CHECK(running_in(camera) == "onExecute");
    CHECK(running_in(arm) == "none");
}

TEST_CASE(
    "of callbacks in several threads, the one that has run longest is known, however deeply a thread nests") {
    const int camera = 0;
    const CallbackScope first(&camera, "camera", "onActivated", nullptr);
    std::thread([&] {
        const CallbackScope second(&camera, "camera", "onEvent", nullptr);
        CHECK(running_in(camera) == "onActivated");
    }).join();
    const auto nest = [&](auto& self, int depth) -> void {
        const CallbackScope scope(&camera, "camera", "deep", nullptr);
        if (depth > 0) self(self, depth - 1);
    };
    nest(nest, 50);
    CHECK(running_in(camera) == "onActivated");
}

TEST_CASE("a thread's text names its innermost callback while it runs, truncated to the available space") {
    tandem::crash::CallbackText text{};
    const std::string long_name(200, 'n');
    {
        const tandem::crash::CallbackPublication publication(&text);
        const CallbackScope outer(nullptr, "camera", "onExecute", nullptr);
        CHECK(std::string(text.component) == "camera");
        CHECK(std::string(text.callback) == "onExecute");
        {
            const CallbackScope inner(nullptr, long_name.c_str(), "move", nullptr);
            CHECK(std::string(text.component) == std::string(sizeof text.component - 1, 'n'));
            CHECK(std::string(text.callback) == "move");
        }
        CHECK(std::string(text.component) == "camera");
        CHECK(std::string(text.callback) == "onExecute");
        std::thread([&] { const CallbackScope other(nullptr, "arm", "move", nullptr); }).join();
        CHECK(std::string(text.component) == "camera");
    }
    CHECK(std::string(text.callback).empty());
    const CallbackScope later(nullptr, "camera", "onExecute", nullptr);
    CHECK(std::string(text.callback).empty());
}
