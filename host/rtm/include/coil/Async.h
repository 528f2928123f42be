// SPDX-License-Identifier: Apache-2.0
#ifndef COIL_ASYNC_H
#define COIL_ASYNC_H
#include <atomic>
#include <coil/Task.h>
#include <utility>

namespace coil {

/// A call in a separate thread.
class Async : public Task {
  public:
    virtual void invoke() = 0;
    virtual bool finished() = 0;
    /// Waits for the end of the call and deletes the object.
    virtual void exit() = 0;
};

template <typename Object, typename Func>
class Async_t : public Async {
  public:
    Async_t(Object* object, Func func, bool auto_delete = false)
        : m_obj(object), m_func(std::move(func)), m_autodelete(auto_delete) {}
    int svc() override {
        m_func(m_obj);
        m_finished = true;
        return 0;
    }
    void finalize() override {
        Task::finalize();
        if (m_autodelete) delete this;
    }
    void invoke() override { activate(); }
    bool finished() override { return m_finished; }
    void exit() override {
        wait();
        delete this;
    }

  private:
    Object* m_obj;
    Func m_func;
    const bool m_autodelete;
    std::atomic<bool> m_finished{false};
};

/// Returns an object that calls `func(object)` in a separate thread, once per invoke(). With auto_delete, the object
/// deletes itself when the call has ended; otherwise exit() deletes it.
template <typename Object, typename Func>
Async_t<Object, Func>* AsyncInvoker(Object* object, Func func, bool auto_delete = false) {
    return new Async_t<Object, Func>(object, std::move(func), auto_delete);
}

} // namespace coil
#endif
