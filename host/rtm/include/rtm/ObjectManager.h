// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_OBJECTMANAGER_H
#define RTC_OBJECTMANAGER_H
#include <algorithm>
#include <mutex>
#include <rtm/RTC.h>
#include <vector>

/// A list of objects, searched with `Predicate(id)` or `Predicate(object)`. The caller keeps ownership of the
/// objects. [any-thread]
template <typename Identifier, typename Object, typename Predicate>
class ObjectManager {
  public:
    using ObjectVector = std::vector<Object*>;

    /// Returns false if such an object is already registered.
    bool registerObject(Object* object) {
        std::lock_guard<std::mutex> lock(m_mutex);
        if (std::any_of(m_objects.begin(), m_objects.end(), Predicate(object))) return false;
        m_objects.push_back(object);
        return true;
    }
    /// Returns the removed object, or NULL if there is none.
    Object* unregisterObject(const Identifier& id) {
        std::lock_guard<std::mutex> lock(m_mutex);
        auto found = std::find_if(m_objects.begin(), m_objects.end(), Predicate(id));
        if (found == m_objects.end()) return nullptr;
        Object* object = *found;
        m_objects.erase(found);
        return object;
    }
    Object* find(const Identifier& id) const {
        std::lock_guard<std::mutex> lock(m_mutex);
        auto found = std::find_if(m_objects.begin(), m_objects.end(), Predicate(id));
        return found == m_objects.end() ? nullptr : *found;
    }
    ObjectVector getObjects() const {
        std::lock_guard<std::mutex> lock(m_mutex);
        return m_objects;
    }
    template <class Pred>
    Pred for_each(Pred p) const {
        std::lock_guard<std::mutex> lock(m_mutex);
        return std::for_each(m_objects.begin(), m_objects.end(), p);
    }

  private:
    mutable std::mutex m_mutex;
    ObjectVector m_objects;
};
#endif
