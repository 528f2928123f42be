// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_OPROSTIMER_H_
#define DEVICE_OPROSTIMER_H_

#include <chrono>
#include <sys/time.h>
#include <unistd.h>

/// Sleeps for X milliseconds.
#define OprosSleep(X) usleep((X)*1000)

/// Two stop watches: one in milliseconds, one in microseconds.
class OprosTimer {
  public:
    OprosTimer() : m_start(clock::now()), m_startMicro(m_start) {}
    virtual ~OprosTimer() {}
    void StartTimeTick() { m_start = clock::now(); }
    unsigned long GetTimeTick() { return since<std::chrono::milliseconds>(m_start); }
    void StartTimeTickMicro() { m_startMicro = clock::now(); }
    unsigned long GetTimeTickMicro() { return since<std::chrono::microseconds>(m_startMicro); }

  private:
    typedef std::chrono::steady_clock clock;
    template <typename Unit>
    static unsigned long since(clock::time_point start) {
        return static_cast<unsigned long>(std::chrono::duration_cast<Unit>(clock::now() - start).count());
    }
    clock::time_point m_start, m_startMicro;
};

#endif
