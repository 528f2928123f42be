// SPDX-License-Identifier: Apache-2.0
#ifndef COIL_TASK_H
#define COIL_TASK_H
#include <thread>

namespace coil {

/// A thread that runs svc(); derive and override.
class Task {
public:
    Task() = default;
    virtual ~Task();
    Task(const Task&) = delete;
    Task& operator=(const Task&) = delete;
    virtual int open(void* args);
    virtual int close(unsigned long flags);
    virtual int svc();
    virtual void activate();
    virtual int wait();
    virtual int suspend();
    virtual int resume();
    virtual void reset();
    virtual void finalize();

private:
    std::thread thread_;
};

} // namespace coil
#endif
