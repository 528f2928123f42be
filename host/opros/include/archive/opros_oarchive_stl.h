// SPDX-License-Identifier: Apache-2.0
// Writes the standard containers. Each is a sequence; a map is a sequence of pairs.
#ifndef OPROS_OARCHIVE_STL_H
#define OPROS_OARCHIVE_STL_H

#include <archive/opros_oarchive.h>

namespace opros {
namespace archive {

/// Removes an overload for types that cannot be archived, so that is_serializable<> is false for their containers.
template <typename T>
using if_serializable = typename std::enable_if<is_serializable<T>::value>::type;

inline void save_this(oarchive& ar, const std::string& t) { ar.save(t); }
template <typename Traits, typename A> // see typeName()
void save_this(oarchive& ar, const std::basic_string<wchar_t, Traits, A>& t) {
    ar.save(t);
}

namespace detail {

template <typename Container>
void save_each(oarchive& ar, const Container& container, std::size_t count) {
    ar.write_sequence_head(count);
    for (typename Container::const_iterator it = container.begin(); it != container.end(); ++it) ar.save(*it);
    ar.write_sequence_end();
}

// Numbers at once, like save_elements().
template <typename T, typename A>
void save_vector(oarchive& ar, const std::vector<T, A>& t, by_primitive) {
    ar.save_sequence(t.data(), t.size());
}
template <typename T, typename A, typename Way>
void save_vector(oarchive& ar, const std::vector<T, A>& t, Way how) {
    ar.write_sequence_head(t.size());
    save_elements(ar, t.data(), static_cast<long>(t.size()), how);
    ar.write_sequence_end();
}

// Writes the element that pop() takes: the front of a queue, the top of the others.
template <typename Queue>
auto save_next(oarchive& ar, const Queue& queue, int) -> decltype(static_cast<void>(queue.front())) {
    ar.save(queue.front());
}
template <typename Stack>
void save_next(oarchive& ar, const Stack& stack, long) {
    ar.save(stack.top());
}
// Container adaptors give access to only one end, so this function empties a copy.
template <typename Adaptor>
void save_adaptor(oarchive& ar, Adaptor copy) {
    ar.write_sequence_head(copy.size());
    for (; !copy.empty(); copy.pop()) save_next(ar, copy, 0);
    ar.write_sequence_end();
}

} // namespace detail

template <typename T, typename A, typename = if_serializable<T>>
void save_this(oarchive& ar, const std::vector<T, A>& t) {
    detail::save_vector(ar, t, typename detail::way<T>::type());
}
// Not written as an array, because its elements are bits without an address.
template <typename A>
void save_this(oarchive& ar, const std::vector<bool, A>& t) {
    ar.write_sequence_head(t.size());
    for (std::size_t i = 0; i < t.size(); ++i) ar.save(static_cast<bool>(t[i]));
    ar.write_sequence_end();
}
template <typename T, typename = if_serializable<T>>
void save_this(oarchive& ar, const std::valarray<T>& t) {
    ar.write_sequence_head(t.size());
    if (t.size() != 0)
        detail::save_elements(ar, &t[0], static_cast<long>(t.size()), typename detail::way<T>::type());
    ar.write_sequence_end();
}
template <typename T, typename A, typename = if_serializable<T>>
void save_this(oarchive& ar, const std::deque<T, A>& t) {
    detail::save_each(ar, t, t.size());
}
template <typename T, typename A, typename = if_serializable<T>>
void save_this(oarchive& ar, const std::list<T, A>& t) {
    detail::save_each(ar, t, t.size());
}
template <typename T, typename C, typename A, typename = if_serializable<T>>
void save_this(oarchive& ar, const std::set<T, C, A>& t) {
    detail::save_each(ar, t, t.size());
}
template <typename T, typename C, typename A, typename = if_serializable<T>>
void save_this(oarchive& ar, const std::multiset<T, C, A>& t) {
    detail::save_each(ar, t, t.size());
}
// std::queue and std::stack, then std::priority_queue.
template <template <typename, typename> class Adaptor, typename T, typename C, typename = if_serializable<T>,
          typename = opros::detail::if_container_adaptor<Adaptor<T, C>>>
void save_this(oarchive& ar, const Adaptor<T, C>& t) {
    detail::save_adaptor(ar, t);
}
template <template <typename, typename, typename> class Adaptor, typename T, typename C, typename L,
          typename = if_serializable<T>, typename = opros::detail::if_container_adaptor<Adaptor<T, C, L>>>
void save_this(oarchive& ar, const Adaptor<T, C, L>& t) {
    detail::save_adaptor(ar, t);
}
template <typename T, typename = if_serializable<T>>
void save_this(oarchive& ar, const std::complex<T>& t) {
    ar.save(t.real());
    ar.save(t.imag());
}
template <typename A, typename B, typename = if_serializable<typename std::remove_const<A>::type>,
          typename = if_serializable<B>>
void save_this(oarchive& ar, const std::pair<A, B>& t) {
    ar.save(t.first);
    ar.save(t.second);
}
template <typename K, typename T, typename C, typename A, typename = if_serializable<K>,
          typename = if_serializable<T>>
void save_this(oarchive& ar, const std::map<K, T, C, A>& t) {
    detail::save_each(ar, t, t.size());
}
template <typename K, typename T, typename C, typename A, typename = if_serializable<K>,
          typename = if_serializable<T>>
void save_this(oarchive& ar, const std::multimap<K, T, C, A>& t) {
    detail::save_each(ar, t, t.size());
}

inline oarchive& operator<<(oarchive& ar, const std::vector<bool>::reference& bit) {
    return ar.save(static_cast<bool>(bit));
}

} // namespace archive
} // namespace opros

#endif
