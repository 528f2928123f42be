// SPDX-License-Identifier: Apache-2.0
// Reads the standard containers: see opros_oarchive_stl.h.
#ifndef OPROS_IARCHIVE_STL_H
#define OPROS_IARCHIVE_STL_H

#include <archive/opros_iarchive.h>
#include <archive/opros_oarchive_stl.h>

namespace opros {
namespace archive {

inline void load_this(iarchive& ar, std::string& t) { ar.load(t); }
template <typename Traits, typename A>
void load_this(iarchive& ar, std::basic_string<wchar_t, Traits, A>& t) {
    ar.load(t);
}

namespace detail {

/// Reads a sequence and passes each element to `take`.
template <typename T, typename Take>
void load_each(iarchive& ar, Take take) {
    const std::size_t count = ar.read_sequence_head();
    for (std::size_t i = 0; i < count; ++i) {
        T element = T();
        ar.load(element);
        take(std::move(element));
    }
    ar.read_sequence_end();
}

// Replace the previous content of the container.
template <typename T, typename Container>
void load_list(iarchive& ar, Container& t) {
    t.clear();
    load_each<T>(ar, [&t](T&& element) { t.push_back(std::move(element)); });
}
template <typename T, typename Container>
void load_set(iarchive& ar, Container& t) {
    t.clear();
    load_each<T>(ar, [&t](T&& element) { t.insert(t.end(), std::move(element)); });
}
template <typename K, typename T, typename Container>
void load_map(iarchive& ar, Container& t) {
    t.clear();
    load_each<std::pair<K, T>>(ar, [&t](std::pair<K, T>&& entry) { t.insert(std::move(entry)); });
}

// Loads all numbers at once, as load_elements() does. With the default allocator, one call does it.
template <typename T>
void load_vector(iarchive& ar, std::vector<T>& t, by_primitive) {
    ar.load_sequence(t);
}
template <typename T, typename A, typename Way>
void load_vector(iarchive& ar, std::vector<T, A>& t, Way how) {
    t.resize(ar.read_sequence_head());
    load_elements(ar, t.data(), static_cast<long>(t.size()), how);
    ar.read_sequence_end();
}

// Pushes in the order of pop(), and therefore the last value first into a stack. A std::priority_queue does not
// depend on the order.
template <typename Queue, typename T>
auto push_all(Queue& queue, const std::vector<T>& values, int) -> decltype(static_cast<void>(queue.front())) {
    for (std::size_t i = 0; i < values.size(); ++i) queue.push(values[i]);
}
template <typename Stack, typename T>
void push_all(Stack& stack, const std::vector<T>& values, long) {
    for (std::size_t i = values.size(); i > 0; --i) stack.push(values[i - 1]);
}
template <typename T, typename Adaptor>
void load_adaptor(iarchive& ar, Adaptor& t) {
    std::vector<T> values;
    load_list<T>(ar, values);
    t = Adaptor();
    push_all(t, values, 0);
}

} // namespace detail

// Reads in place, so that a vector of the same size as before allocates no memory.
template <typename T, typename A, typename = if_serializable<T>>
void load_this(iarchive& ar, std::vector<T, A>& t) {
    detail::load_vector(ar, t, typename detail::way<T>::type());
}
template <typename A>
void load_this(iarchive& ar, std::vector<bool, A>& t) {
    detail::load_list<bool>(ar, t);
}
template <typename T, typename = if_serializable<T>>
void load_this(iarchive& ar, std::valarray<T>& t) {
    const std::size_t count = ar.read_sequence_head();
    if (t.size() != count) t.resize(count);
    if (count != 0)
        detail::load_elements(ar, &t[0], static_cast<long>(count), typename detail::way<T>::type());
    ar.read_sequence_end();
}
template <typename T, typename A, typename = if_serializable<T>>
void load_this(iarchive& ar, std::deque<T, A>& t) {
    detail::load_list<T>(ar, t);
}
template <typename T, typename A, typename = if_serializable<T>>
void load_this(iarchive& ar, std::list<T, A>& t) {
    detail::load_list<T>(ar, t);
}
template <typename T, typename C, typename A, typename = if_serializable<T>>
void load_this(iarchive& ar, std::set<T, C, A>& t) {
    detail::load_set<T>(ar, t);
}
template <typename T, typename C, typename A, typename = if_serializable<T>>
void load_this(iarchive& ar, std::multiset<T, C, A>& t) {
    detail::load_set<T>(ar, t);
}
// std::queue and std::stack, then std::priority_queue.
template <template <typename, typename> class Adaptor, typename T, typename C, typename = if_serializable<T>,
          typename = opros::detail::if_container_adaptor<Adaptor<T, C>>>
void load_this(iarchive& ar, Adaptor<T, C>& t) {
    detail::load_adaptor<T>(ar, t);
}
template <template <typename, typename, typename> class Adaptor, typename T, typename C, typename L,
          typename = if_serializable<T>, typename = opros::detail::if_container_adaptor<Adaptor<T, C, L>>>
void load_this(iarchive& ar, Adaptor<T, C, L>& t) {
    detail::load_adaptor<T>(ar, t);
}
template <typename T, typename = if_serializable<T>>
void load_this(iarchive& ar, std::complex<T>& t) {
    T real = T(), imaginary = T();
    ar.load(real);
    ar.load(imaginary);
    t = std::complex<T>(real, imaginary);
}
template <typename A, typename B, typename = if_serializable<typename std::remove_const<A>::type>,
          typename = if_serializable<B>>
void load_this(iarchive& ar, std::pair<A, B>& t) {
    ar.load(const_cast<typename std::remove_const<A>::type&>(t.first));
    ar.load(t.second);
}
template <typename K, typename T, typename C, typename A, typename = if_serializable<K>,
          typename = if_serializable<T>>
void load_this(iarchive& ar, std::map<K, T, C, A>& t) {
    detail::load_map<K, T>(ar, t);
}
template <typename K, typename T, typename C, typename A, typename = if_serializable<K>,
          typename = if_serializable<T>>
void load_this(iarchive& ar, std::multimap<K, T, C, A>& t) {
    detail::load_map<K, T>(ar, t);
}

// An element of std::vector<bool> is not a bool&.
inline iarchive& operator>>(iarchive& ar, std::vector<bool>::reference bit) {
    bool value = false;
    ar.load(value);
    bit = value;
    return ar;
}

} // namespace archive
} // namespace opros

#endif
