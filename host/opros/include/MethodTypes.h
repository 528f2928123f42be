// SPDX-License-Identifier: Apache-2.0
// The types of a method's result and arguments, stripped of const and reference. Ours.
#ifndef METHODTYPES_H_
#define METHODTYPES_H_

#include <Method.h>
#include <OPRoSTypes.h>
#include <ServicePortConnector.h>

#include <type_traits>
#include <typeinfo>
#include <utility>
#include <vector>

namespace opros {
namespace detail {

/// T without reference and const.
template <typename T>
using bare = typename std::remove_cv<typename std::remove_reference<T>::type>::type;

// True if all conditions hold: C++14 has no fold expressions.
template <bool...>
struct bools {};
template <bool... all>
using all_true = std::is_same<bools<true, all...>, bools<all..., true>>;

/// Whether values of T can be default-constructed and archived, as encoded calls require.
template <typename T>
struct can_cross : std::integral_constant<bool, archive::is_serializable<T>::value &&
                                                    std::is_default_constructible<T>::value> {};
template <>
struct can_cross<void> : std::true_type {};

/// How an argument of type P crosses: as a value of the type `stored`, which P refers or points to. Text is not
/// passed as a value: `char*` stays a pointer, which cannot cross.
template <typename P>
struct passing {
    typedef bare<P> stored;
    static const bool by_pointer = false;
    static const bool writable = false; ///< the method may write it, and the caller sees the change
};
template <typename T>
struct passing<T&> : passing<typename std::remove_cv<T>::type> {
    static const bool writable = !std::is_const<T>::value;
};
template <typename T>
struct passing<T*> {
    static const bool by_pointer =
        can_cross<bare<T>>::value && !std::is_void<T>::value && !std::is_same<bare<T>, char>::value;
    typedef typename std::conditional<by_pointer, bare<T>, T*>::type stored;
    static const bool writable = by_pointer && !std::is_const<T>::value;
};

/// Storage for one argument: its value, and a pointer to it if the method takes one.
template <typename P, bool by_pointer = passing<P>::by_pointer>
struct argument_slot {
    typename passing<P>::stored value = typename passing<P>::stored();
    const void* address() { return &value; }
};
template <typename P>
struct argument_slot<P, true> {
    typename passing<P>::stored value = typename passing<P>::stored();
    bare<P> pointer = 0;
    const void* address() {
        pointer = &value;
        return &pointer;
    }
};

/// Whether the result and all arguments of a method R(P...) can be archived.
template <typename R, typename... P>
using method_crosses = all_true<can_cross<bare<R>>::value, can_cross<typename passing<P>::stored>::value...>;

// loader reads one value and drops it. describer does so for each type of a method.
template <typename R>
struct loader {
    static void load(archive::iarchive& in) {
        R value = R();
        in >> value;
    }
    static void load_result(MethodDescription& to) { load(to.result()); }
};
template <>
struct loader<void> {
    static void load_result(MethodDescription&) {}
};

template <bool crosses, typename R, typename... P>
struct describer {
    static bool describe(MethodDescription& to) {
        loader<bare<R>>::load_result(to);
        const int in_order[] = {
            0, (loader<typename passing<P>::stored>::load(to.argument(passing<P>::writable)), 0)...};
        static_cast<void>(in_order);
        return true;
    }
};
template <typename R, typename... P>
struct describer<false, R, P...> {
    static bool describe(MethodDescription&) { return false; }
};

/// The types of a method in tables. Otherwise the classes of methods would be compiled once for each signature.
struct MethodSignature {
    const std::type_info* const* types; ///< the result, then the arguments
    const bool* writable;               ///< for each argument: passing<P>::writable
    int arity;
    bool (*describe)(MethodDescription& to); ///< as Method::describe()

    std::vector<const std::type_info*> list() const {
        return std::vector<const std::type_info*>(types, types + arity + 1);
    }
    /// Returns true if a call was made with exactly these argument types.
    bool match(const std::type_info* const* given, int count) const {
        if (count != arity) return false;
        for (int i = 0; i < count; ++i)
            if (given[i] != types[i + 1]) return match_by_name(given);
        return true;
    }

  private:
    // For libraries that do not share the types' type_info.
    bool match_by_name(const std::type_info* const* given) const {
        for (int i = 0; i < arity; ++i)
            if (*given[i] != *types[i + 1]) return false;
        return true;
    }
};

/// Returns the signature of a method R(P...).
template <typename R, typename... P>
const MethodSignature& signature_of() {
    static const std::type_info* const types[] = {&typeid(R), &typeid(bare<P>)...};
    static const bool writable[] = {passing<P>::writable..., false};
    static const MethodSignature signature = {types, writable, static_cast<int>(sizeof...(P)),
                                              &describer<method_crosses<R, P...>::value, R, P...>::describe};
    return signature;
}

/// One argument of a call in the form that the method takes: a reference to the caller's value, or a copy if the
/// method may change it but the caller's value must not change.
template <typename P>
struct argument {
    argument(const void* given, bool) : value(static_cast<const bare<P>*>(given)) {}
    const bare<P>& get() { return *value; }
    const bare<P>* value;
};
template <typename P>
struct argument<P&> {
    argument(const void* given, bool writable)
        : copy(writable ? 0 : new bare<P>(*static_cast<const bare<P>*>(given))),
          value(writable ? static_cast<bare<P>*>(const_cast<void*>(given)) : copy) {}
    ~argument() { delete copy; }
    P& get() { return *value; }
    bare<P>* copy; // without <memory>, because some components define their own shared_ptr
    bare<P>* value;

  private:
    argument(const argument&);
    argument& operator=(const argument&);
};
template <typename P>
struct argument<const P&> {
    argument(const void* given, bool) : value(static_cast<const P*>(given)) {}
    const P& get() { return *value; }
    const P* value;
};
template <typename P>
struct argument<P&&> {
    argument(const void* given, bool) : value(*static_cast<const bare<P>*>(given)) {}
    P&& get() { return std::move(value); }
    bare<P> value;
};

/// Whether a caller that passed an argument as A&& lets the method write it.
template <typename A>
struct is_writable
    : std::integral_constant<bool, std::is_lvalue_reference<A>::value &&
                                       !std::is_const<typename std::remove_reference<A>::type>::value> {};

/// The functions of a CallValue of type T. `encode` and `decode` handle the value at the address. `drop` reads a
/// value that is not needed. `encode_pointee` writes a default-constructed value for NULL.
template <typename T, bool crosses = can_cross<T>::value>
struct value_functions {
    static void encode(const void* address, archive::oarchive& to) { to << *static_cast<const T*>(address); }
    static void decode(void* address, archive::iarchive& from) { from >> *static_cast<T*>(address); }
    static void drop(void*, archive::iarchive& from) {
        T value = T();
        from >> value;
    }
    static void encode_pointee(const void* address, archive::oarchive& to) {
        if (address) return encode(address, to);
        const T value = T();
        to << value;
    }
};
template <typename T>
struct value_functions<T, false> {
    static void encode(const void*, archive::oarchive&) { throw archive::archive_type_exception(); }
    static void decode(void*, archive::iarchive&) { throw archive::archive_type_exception(); }
    static void drop(void*, archive::iarchive&) { throw archive::archive_type_exception(); }
    static void encode_pointee(const void*, archive::oarchive&) { throw archive::archive_type_exception(); }
};

/// Converts an argument, passed by the caller as A&&, to a CallValue. A pointer becomes the value that it points to.
template <typename A, bool by_pointer = passing<bare<A>>::by_pointer>
struct call_value {
    typedef value_functions<bare<A>> functions;
    static CallValue of(const bare<A>& argument) {
        return {const_cast<bare<A>*>(&argument), &functions::encode,
                is_writable<A>::value ? &functions::decode : &functions::drop};
    }
};
template <typename A>
struct call_value<A, true> {
    typedef passing<bare<A>> how;
    typedef value_functions<typename how::stored> functions;
    static CallValue of(const bare<A>& pointer) {
        return {const_cast<typename how::stored*>(pointer), &functions::encode_pointee,
                pointer && how::writable ? &functions::decode : &functions::drop};
    }
};

/// Passes an argument, given by the caller as A&&, in a call by copies. A pointer becomes the value that it points
/// to.
template <typename A, bool by_pointer = passing<bare<A>>::by_pointer>
struct call_param {
    typedef bare<A> type;
    static void add(std::vector<opros_params>& params, const type& value) { params.emplace_back(value); }
    /// Assigns the value that the method left in `from` to the caller's argument if it may be written.
    static void write_back(type& argument, opros_params& from, std::true_type) {
        if (const type* value = opros_params_cast<type>(&from)) argument = *value;
    }
    static void write_back(const type&, opros_params&, std::false_type) {}
};
template <typename A>
struct call_param<A, true> {
    typedef passing<bare<A>> how;
    typedef typename how::stored stored;
    static void add(std::vector<opros_params>& params, bare<A> pointer) {
        if (pointer)
            params.emplace_back(static_cast<const stored&>(*pointer));
        else
            params.emplace_back(stored());
    }
    template <typename Writable>
    static void write_back(bare<A> pointer, opros_params& from, Writable) {
        assign(pointer, opros_params_cast<stored>(&from), std::integral_constant<bool, how::writable>());
    }

  private:
    static void assign(bare<A> pointer, const stored* value, std::true_type) {
        if (pointer && value) *pointer = *value;
    }
    static void assign(bare<A>, const stored*, std::false_type) {}
};

/// Returns the result of a method without one.
inline CallValue no_value() {
    struct nothing {
        static void encode(const void*, archive::oarchive&) {}
        static void decode(void*, archive::iarchive&) {}
    };
    return {0, &nothing::encode, &nothing::decode};
}

} // namespace detail
} // namespace opros

#endif
