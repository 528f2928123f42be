// SPDX-License-Identifier: Apache-2.0
// Only in builds with the thread sanitizer. The sanitizer of g++ 12 does not intercept pthread_mutex_clocklock(), which
// std::timed_mutex calls for times of the steady clock. It therefore regards such a mutex as unlocked and reports each
// unlock. This definition is found before libc's and calls pthread_mutex_timedlock(), which the sanitizer does
// intercept.
#include <ctime>
#include <pthread.h>

extern "C" int pthread_mutex_clocklock(pthread_mutex_t* mutex, clockid_t clock,
                                       const timespec* until) noexcept {
    timespec now{}, real{};
    clock_gettime(clock, &now);
    clock_gettime(CLOCK_REALTIME, &real);
    constexpr long second = 1'000'000'000;
    // `until` on the real-time clock: now there, plus what is left on `clock`.
    const long nanoseconds = real.tv_nsec + until->tv_nsec - now.tv_nsec + second; // above 0
    real.tv_sec += until->tv_sec - now.tv_sec - 1 + nanoseconds / second;
    real.tv_nsec = nanoseconds % second;
    return pthread_mutex_timedlock(mutex, &real);
}
