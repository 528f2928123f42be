// SPDX-License-Identifier: Apache-2.0
#ifndef COIL_CLOCKMANAGER_H
#define COIL_CLOCKMANAGER_H
#include <chrono>
#include <coil/Singleton.h>
#include <mutex>
#include <string>

namespace coil {

/// A clock: its time since the epoch. settime() returns false if the clock cannot be set. [any-thread]
class IClock {
  public:
    virtual ~IClock() = default;
    virtual std::chrono::nanoseconds gettime() const = 0;
    virtual bool settime(std::chrono::nanoseconds clocktime) = 0;
};

/// The system clock. Cannot be set.
class SystemClock : public IClock {
  public:
    std::chrono::nanoseconds gettime() const override {
        return std::chrono::system_clock::now().time_since_epoch();
    }
    bool settime(std::chrono::nanoseconds) override { return false; }
};

/// A clock for simulated time: it stands still between two calls of settime().
class LogicalClock : public IClock {
  public:
    std::chrono::nanoseconds gettime() const override {
        std::lock_guard<std::mutex> lock(m_mutex);
        return m_now;
    }
    bool settime(std::chrono::nanoseconds clocktime) override {
        std::lock_guard<std::mutex> lock(m_mutex);
        m_now = clocktime;
        return true;
    }

  private:
    mutable std::mutex m_mutex;
    std::chrono::nanoseconds m_now{0};
};

/// A clock that continues from the time to which it was set.
class AdjustedClock : public IClock {
  public:
    std::chrono::nanoseconds gettime() const override {
        std::lock_guard<std::mutex> lock(m_mutex);
        return steady() + m_offset;
    }
    bool settime(std::chrono::nanoseconds clocktime) override {
        std::lock_guard<std::mutex> lock(m_mutex);
        m_offset = clocktime - steady();
        return true;
    }

  private:
    static std::chrono::nanoseconds steady() { return std::chrono::steady_clock::now().time_since_epoch(); }
    mutable std::mutex m_mutex;
    std::chrono::nanoseconds m_offset{0};
};

/// The clocks of the process: `logical`, `adjusted`. Any other name is the system clock.
class ClockManager : public Singleton<ClockManager> {
  public:
    IClock& getClock(const std::string& clocktype) {
        if (clocktype == "logical") return m_logicalClock;
        if (clocktype == "adjusted") return m_adjustedClock;
        return m_systemClock;
    }

  private:
    SystemClock m_systemClock;
    LogicalClock m_logicalClock;
    AdjustedClock m_adjustedClock;
};

} // namespace coil
#endif
