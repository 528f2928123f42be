// SPDX-License-Identifier: Apache-2.0
#ifndef COIL_TASK_H
#define COIL_TASK_H
#include <atomic>
#include <rtm/TandemAbi.h>
#include <thread>

namespace coil {

/// A thread that runs svc() and then finalize(), which derived classes override.
class Task {
  public:
    Task() = default;
    virtual ~Task();
    Task(const Task&) = delete;
    Task& operator=(const Task&) = delete;
    virtual int open(void* args = nullptr);
    virtual int close(unsigned long flags = 0);
    virtual int svc();
    /// Starts the thread. Does nothing while it runs.
    virtual void activate();
    virtual int wait();
    virtual int suspend();
    virtual int resume();
    virtual void reset();
    virtual void finalize();

  private:
    std::thread thread_;
    std::atomic<bool> ended_{false};
};

} // namespace coil
#endif
