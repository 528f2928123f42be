// SPDX-License-Identifier: Apache-2.0
#ifndef COIL_PERIODICTASKBASE_H
#define COIL_PERIODICTASKBASE_H
#include <chrono>
#include <coil/Task.h>
#include <coil/TimeMeasure.h>
#include <coil/TimeValue.h>
#include <functional>
#include <memory>
#include <utility>

namespace coil {

/// A function object as a task, as in 1.x.
class TaskFuncBase {
  public:
    virtual ~TaskFuncBase() = default;
    virtual int operator()() = 0;
};

/// Calls a member function.
template <typename T, typename F = int (*)()>
class TaskFunc : public TaskFuncBase {
  public:
    TaskFunc(T* object, F function) : m_obj(object), m_func(function) {}
    int operator()() override { return (m_obj->*m_func)(); }
    T* m_obj;
    F m_func;
};

/// A function that is called periodically in a separate thread.
class PeriodicTaskBase : public Task {
  public:
    void activate() override = 0;
    void finalize() override = 0;
    int suspend() override = 0;
    int resume() override = 0;
    /// Makes a suspended task call its function once.
    virtual void signal() = 0;
    virtual void setTask(std::function<void()> func) = 0;
    virtual void setPeriod(std::chrono::nanoseconds period) = 0;
    virtual void executionMeasure(bool value) = 0;
    virtual void executionMeasureCount(unsigned int n) = 0;
    virtual void periodicMeasure(bool value) = 0;
    virtual void periodicMeasureCount(unsigned int n) = 0;
    virtual TimeMeasure::Statistics getExecStat() = 0;
    virtual TimeMeasure::Statistics getPeriodStat() = 0;

    // 1.x: objects and member functions as tasks, periods in seconds.
    bool setTask(TaskFuncBase* func, bool delete_in_dtor = true) {
        if (func == nullptr) return false;
        if (delete_in_dtor) {
            std::shared_ptr<TaskFuncBase> owned(func);
            setTask(std::function<void()>([owned] { (*owned)(); }));
        } else {
            setTask(std::function<void()>([func] { (*func)(); }));
        }
        return true;
    }
    template <class Object, class Result>
    bool setTask(Object* object, Result (Object::*function)()) {
        if (object == nullptr) return false;
        setTask(std::function<void()>([object, function] { (object->*function)(); }));
        return true;
    }
    void setPeriod(double seconds) { setPeriod(TimeValue(seconds)); }
    void setPeriod(const TimeValue& period) { setPeriod(std::chrono::nanoseconds(period.microseconds())); }
};

} // namespace coil
#endif
