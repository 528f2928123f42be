// SPDX-License-Identifier: Apache-2.0
#ifndef COIL_CLOCKMANAGER_H
#define COIL_CLOCKMANAGER_H
#include <chrono>
#include <coil/Singleton.h>
#include <mutex>
#include <string>

namespace coil {

/// Time since the epoch of a clock, which may be set. [any-thread]
class IClock {
  public:
    virtual ~IClock() = default;
    virtual std::chrono::nanoseconds gettime() const = 0;
    virtual bool settime(std::chrono::nanoseconds clocktime) = 0;
};

/// The system's; setting it is refused.
class SystemClock : public IClock {
  public:
    std::chrono::nanoseconds gettime() const override {
        return std::chrono::system_clock::now().time_since_epoch();
    }
    bool settime(std::chrono::nanoseconds) override { return false; }
};

/// Stands still between two settime().
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

/// Runs on from what it was set to.
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

/// The process's clocks: `logical`, `adjusted`, anything else is the system's.
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
