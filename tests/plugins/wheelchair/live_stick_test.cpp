// SPDX-License-Identifier: Apache-2.0
#include "plugins/wheelchair/core/record/live_stick.hpp"

#include <catch2/catch.hpp>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <limits>
#include <thread>

#include "plugins/wheelchair/core/record/scenario.hpp"

using namespace tandem::wheelchair;

namespace {

/// A path without a file. A file that the test creates is removed.
struct StickPath {
    std::string path =
        (std::filesystem::temp_directory_path() / ("live_stick_test-" + std::to_string(getpid()))).string();
    StickPath() { std::filesystem::remove(path); }
    ~StickPath() { std::filesystem::remove(path); }
};

} // namespace

TEST_CASE("a live stick is read as it was written, in whole counts within its limits") {
    const StickPath file;
    LiveStick writer(file.path, LiveStick::Role::writer);
    const LiveStick reader(file.path, LiveStick::Role::reader);
    CHECK(reader.read().y == 0); // nobody has moved it yet
    writer.write({-12.4, 1999.7, false});
    CHECK(reader.read().x == -12);
    CHECK(reader.read().y == 2000);
    CHECK_FALSE(reader.read().emergency_stop);
    writer.write({std::numeric_limits<double>::infinity(), -1e9, true});
    CHECK(reader.read().x == 0);
    CHECK(reader.read().y == -2000);
    CHECK(reader.read().emergency_stop);
}

TEST_CASE("a live stick without new positions is released after 200 ms") {
    const StickPath file;
    LiveStick writer(file.path, LiveStick::Role::writer);
    const LiveStick reader(file.path, LiveStick::Role::reader);
    writer.write({100, 200, false});
    std::this_thread::sleep_for(std::chrono::nanoseconds(stick_silence_ns + 1'000'000));
    CHECK(reader.read().x == 0);
    CHECK(reader.read().y == 0);
}

TEST_CASE("a reader never sees half of a position") {
    const StickPath file;
    LiveStick writer(file.path, LiveStick::Role::writer);
    const LiveStick reader(file.path, LiveStick::Role::reader);
    std::atomic<bool> ends{false};
    std::thread writes([&] {
        for (int i = 0; !ends; i = (i + 1) % 2000) writer.write({double(i), double(-i), false});
    });
    int torn = 0;
    for (int i = 0; i < 200'000; ++i) {
        const auto position = reader.read();
        torn += position.x != -position.y ? 1 : 0;
    }
    ends = true;
    writes.join();
    CHECK(torn == 0);
}

TEST_CASE("a scenario follows a live stick, and a file that is not one is refused") {
    const StickPath file;
    {
        LiveStick writer(file.path, LiveStick::Role::writer);
        CHECK(is_live_stick(file.path));
        const Scenario scenario = load_scenario("", file.path);
        CHECK(scenario.name == "recorded");
        writer.write({0, 900, false});
        CHECK(scenario.stick_at(3).y == 900);
        CHECK_THROWS_AS(LiveStick(file.path, LiveStick::Role::writer), InputError); // the file already exists
    }
    std::ofstream(file.path, std::ios::trunc) << "TANDSTK\nshort";
    CHECK_THROWS_AS(load_scenario("", file.path), InputError);
    CHECK_FALSE(is_live_stick("/nonexistent"));
}
