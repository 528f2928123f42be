// SPDX-License-Identifier: Apache-2.0
// The types of a method's result and arguments, stripped of const and reference. Ours.
#ifndef METHODTYPES_H_
#define METHODTYPES_H_

#include <OPRoSTypes.h>

#include <tuple>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <vector>

namespace opros {
namespace detail {

/// T without reference and const.
template <typename T>
using bare = typename std::remove_cv<typename std::remove_reference<T>::type>::type;

// Whether all of the conditions hold: C++14 has no fold expressions.
template <bool...>
struct bools {};
template <bool... all>
using all_true = std::is_same<bools<true, all...>, bools<all..., true>>;

/// Whether values of T can be made from nothing and archived, as encoded calls need it.
template <typename T>
struct can_cross : std::integral_constant<bool, archive::is_serializable<T>::value &&
                                                    std::is_default_constructible<T>::value> {};
template <>
struct can_cross<void> : std::true_type {};

/// What is known of a method R(P...).
template <typename R, typename... P>
struct method_types {
    typedef std::tuple<bare<P>...> arguments;
    static const bool can_cross =
        all_true<detail::can_cross<bare<R>>::value, detail::can_cross<bare<P>>::value...>::value;

    /// The result, then the arguments.
    static std::vector<const std::type_info*> list() { return {&typeid(R), &typeid(bare<P>)...}; }

    /// Whether a call was made with exactly these argument types.
    static bool match(const std::type_info* const* given, int count) {
        const std::type_info* const own[] = {&typeid(bare<P>)..., &typeid(void)};
        if (count != static_cast<int>(sizeof...(P))) return false;
        for (int i = 0; i < count; ++i)
            if (*given[i] != *own[i]) return false;
        return true;
    }
};

// loader reads one value and drops it; describer does so for each type of a method: an archive that records what it
// is asked for learns the signature.
template <typename R, bool crosses>
struct loader {
    static void load(archive::iarchive& in) {
        R value = R();
        in >> value;
    }
};
template <>
struct loader<void, true> {
    static void load(archive::iarchive&) {}
};

template <bool crosses, typename R, typename... P>
struct describer {
    static bool describe(archive::iarchive& arguments, archive::iarchive& result) {
        const int in_order[] = {0, (loader<bare<P>, true>::load(arguments), 0)...};
        static_cast<void>(in_order);
        loader<R, true>::load(result);
        return true;
    }
};
template <typename R, typename... P>
struct describer<false, R, P...> {
    static bool describe(archive::iarchive&, archive::iarchive&) { return false; }
};

/// One argument of a call as the method wants it: a reference to what the caller has, or a copy where the method
/// may change it.
template <typename P>
struct argument {
    explicit argument(const void* given) : value(static_cast<const bare<P>*>(given)) {}
    const bare<P>& get() { return *value; }
    const bare<P>* value;
};
template <typename P>
struct copied_argument {
    explicit copied_argument(const void* given) : value(*static_cast<const bare<P>*>(given)) {}
    bare<P> value;
};
template <typename P>
struct argument<P&> : copied_argument<P> {
    using copied_argument<P>::copied_argument;
    P& get() { return this->value; }
};
template <typename P>
struct argument<const P&> {
    explicit argument(const void* given) : value(static_cast<const P*>(given)) {}
    const P& get() { return *value; }
    const P* value;
};
template <typename P>
struct argument<P&&> : copied_argument<P> {
    using copied_argument<P>::copied_argument;
    P&& get() { return std::move(this->value); }
};

} // namespace detail
} // namespace opros

#endif
