// SPDX-License-Identifier: Apache-2.0
#ifndef RTM_LISTENERHOLDER_H
#define RTM_LISTENERHOLDER_H
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

namespace RTM {
namespace util {

/// A list of listeners. `autoclean`: the listener is deleted when it is removed or with the list. Calls listeners in
/// the order in which they were added. [any-thread]
template <class ListenerClass>
class ListenerHolder {
  public:
    ListenerHolder() = default;
    ListenerHolder(const ListenerHolder&) = delete;
    ListenerHolder& operator=(const ListenerHolder&) = delete;
    virtual ~ListenerHolder();
    virtual void addListener(ListenerClass* listener, bool autoclean);
    virtual void removeListener(ListenerClass* listener);
    /// Calls `call(listener)` with the mutex held. The mutex is recursive and the loop uses an index, so that a
    /// listener may add others. An empty list costs one load: a component's cycle looks at four of them.
    template <class Call>
    void forEach(Call call) {
        if (m_count.load(std::memory_order_acquire) == 0) return;
        std::lock_guard<std::recursive_mutex> lock(m_mutex);
        for (std::size_t i = 0; i < m_listeners.size(); ++i) call(*m_listeners[i].first);
    }

  protected:
    std::atomic<std::size_t> m_count{0}; ///< of the listeners
    std::recursive_mutex m_mutex;
    std::vector<std::pair<ListenerClass*, bool>> m_listeners;
};

// Outside the class and therefore not inline: Tandem's library contains these functions for its own listeners
// (`extern template` below each type of listener), so that components do not compile them again.
template <class ListenerClass>
ListenerHolder<ListenerClass>::~ListenerHolder() {
    for (auto& entry : m_listeners)
        if (entry.second) delete entry.first;
}
template <class ListenerClass>
void ListenerHolder<ListenerClass>::addListener(ListenerClass* listener, bool autoclean) {
    std::lock_guard<std::recursive_mutex> lock(m_mutex);
    m_listeners.emplace_back(listener, autoclean);
    m_count = m_listeners.size();
}
template <class ListenerClass>
void ListenerHolder<ListenerClass>::removeListener(ListenerClass* listener) {
    std::lock_guard<std::recursive_mutex> lock(m_mutex);
    auto found = std::find_if(m_listeners.begin(), m_listeners.end(),
                              [&](const std::pair<ListenerClass*, bool>& e) { return e.first == listener; });
    if (found == m_listeners.end()) return;
    if (found->second) delete found->first;
    m_listeners.erase(found);
    m_count = m_listeners.size();
}

} // namespace util
} // namespace RTM
#endif
