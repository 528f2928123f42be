// SPDX-License-Identifier: Apache-2.0
// A counted pointer. Its copies share one object, also between components.
#ifndef OPROS_SMART_PTR_H
#define OPROS_SMART_PTR_H

#include <exception>
#include <memory>
#include <utility>

#ifndef smart_ptr_assert
#define smart_ptr_assert(func)                                                                               \
    {                                                                                                        \
        if (!(func)) throw std::exception();                                                                 \
    }
#endif

namespace opros {

/// Counts like std::shared_ptr, with upstream's interface. Copies: [any-thread]. The object itself is not protected.
template <typename T>
class smart_ptr {
  public:
    typedef T element_type;
    typedef T value_type;
    typedef T* pointer;

    smart_ptr() {}
    smart_ptr(T* p) : m_shared(p) {}
    virtual ~smart_ptr() {}
    smart_ptr(const smart_ptr& other) : m_shared(other.m_shared) {}
    smart_ptr& operator=(const smart_ptr& other) {
        m_shared = other.m_shared;
        return *this;
    }
    template <typename Y>
    smart_ptr& operator=(const smart_ptr<Y>& other) {
        m_shared = std::static_pointer_cast<T>(other.m_shared);
        return *this;
    }

    void swap(smart_ptr& other) { m_shared.swap(other.m_shared); }
    /// Takes ownership.
    void reset(T* p) { m_shared.reset(p); }
    T* get() const { return m_shared.get(); }
    bool isNULL() const { return !m_shared; }
    // Both throw std::exception if there is no object.
    T* operator->() const {
        smart_ptr_assert(m_shared.get() != 0);
        return m_shared.get();
    }
    T& operator*() const {
        smart_ptr_assert(m_shared.get() != 0);
        return *m_shared;
    }

  private:
    template <typename Y>
    friend class smart_ptr;
    std::shared_ptr<T> m_shared;
};

} // namespace opros

#endif
