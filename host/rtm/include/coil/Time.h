// SPDX-License-Identifier: Apache-2.0
// Names of OpenRTM-aist 1.x.
#ifndef COIL_TIME_H
#define COIL_TIME_H
#include <chrono>
#include <coil/TimeValue.h>
#include <ctime>
#include <iostream>
#include <sys/time.h>
#include <sys/types.h>
#include <thread>
#include <unistd.h>

namespace coil {

inline unsigned int sleep(unsigned int seconds) {
    std::this_thread::sleep_for(std::chrono::seconds(seconds));
    return 0;
}
inline int sleep(TimeValue interval) {
    std::this_thread::sleep_for(interval.microseconds());
    return 0;
}
inline int usleep(useconds_t microseconds) {
    std::this_thread::sleep_for(std::chrono::microseconds(microseconds));
    return 0;
}
inline int gettimeofday(struct timeval* now, struct timezone* zone = nullptr) {
    return ::gettimeofday(now, zone);
}
inline TimeValue gettimeofday() {
    timeval now;
    ::gettimeofday(&now, nullptr);
    return TimeValue(now.tv_sec, now.tv_usec);
}
inline int settimeofday(const struct timeval* now, const struct timezone* zone) {
    return ::settimeofday(now, zone);
}

} // namespace coil
#endif
