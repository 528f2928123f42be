// SPDX-License-Identifier: Apache-2.0
// The faults that the two tank components have, by name. The functions are static: exported symbols do not name them.
#pragma once

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>
#include <thread>
#include <unistd.h>

struct TankSensor {
    int level;
    void (*on_alarm)();
};

static int read_level(const volatile TankSensor* sensor) { return sensor->level; }

static int recurse(int depth) {
    volatile char buffer[1024] = {static_cast<char>(depth)};
    return depth < 0 ? 0 : recurse(depth + 1) + buffer[0];
}

static void watch_valve() { throw std::runtime_error("valve 3 does not answer"); }

/// Causes the fault with this name; nothing for the empty name.
static void have_fault(const std::string& fault) {
    static TankSensor* volatile no_sensor = nullptr; // volatile: the compiler must not see the faults
    static volatile TankSensor sensor{0, nullptr};
    if (fault == "null pointer") read_level(no_sensor);
    if (fault == "null function") sensor.on_alarm();
    if (fault == "stack overflow") recurse(0);
    if (fault == "division by zero") {
        volatile int zero = sensor.level;
        sensor.level = 7 / zero;
    }
    if (fault == "abort") std::abort();
    if (fault == "throws") watch_valve();
    if (fault == "own thread") {
        std::thread(watch_valve).detach();
        std::this_thread::sleep_for(std::chrono::seconds(60));
    }
    static int calls = 0; // only of the component with this fault
    static const std::string when_file_exists = "hang when there is the file ";
    const bool hangs_now = fault.compare(0, when_file_exists.size(), when_file_exists) == 0 &&
                           access(fault.c_str() + when_file_exists.size(), F_OK) == 0;
    if (hangs_now || fault == "hang" || (fault == "hang later" && ++calls > 20))
        for (;;) std::this_thread::sleep_for(std::chrono::seconds(60));
    if (fault == "damaged heap") { // the fault is found by the allocator
        volatile long* block = static_cast<long*>(std::malloc(40));
        volatile int in_front = -1;
        block[in_front] = 0x5555555555555555;
        std::free(const_cast<long*>(block));
    }
}
