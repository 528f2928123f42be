// SPDX-License-Identifier: Apache-2.0
// Methods that a component provides. Generated code makes one with makeProvidedMethod(), keeps it as a Method* and
// calls it as a ProvidedMethod<R>: the classes form one chain of single inheritance, so that the address is the same.
#ifndef PROVIDEDMETHOD_H_
#define PROVIDEDMETHOD_H_

#include <ArgumentNumberException.h>
#include <MethodInvokeException.h>
#include <MethodTypes.h>
#include <ProvidedMethodInterface.h>

#include <cstddef>

/// A provided method of which only the type of the result is known.
template <typename RetType>
class ProvidedMethod : public ProvidedMethodInterface {
  public:
    ProvidedMethod(int argNum, int callType)
        : m_returnType(getTypeName<RetType>()), m_arity(argNum), m_callType(callType) {}
    virtual std::string& getReturnType() { return m_returnType; }
    virtual int getArity() { return m_arity; }
    virtual int getCallType() { return m_callType; }

    /// Calls the method. The arguments must have exactly the types that it declares, apart from const and
    /// reference: ArgumentNumberException or MethodInvokeException otherwise.
    template <typename... P>
    RetType operator()(const P&... arguments) {
        const std::type_info* const types[] = {&typeid(P)..., 0};
        const void* const values[] = {static_cast<const void*>(&arguments)..., 0};
        return invoke(types, values, static_cast<int>(sizeof...(P)));
    }

    /// The same with the arguments' types and addresses.
    virtual RetType invoke(const std::type_info* const* types, const void* const* values, int count) = 0;

  protected:
    std::string m_returnType;
    const int m_arity;
    const int m_callType;
};

namespace opros {
namespace detail {

/// A provided method whose types are all known, and the function it calls.
template <typename Function, typename R, typename... P>
class bound_method : public ProvidedMethod<R> {
  public:
    bound_method(const Function& function, const char* name, int callType)
        : ProvidedMethod<R>(static_cast<int>(sizeof...(P)), callType), m_function(function) {
        this->m_name = name;
    }

    virtual R invoke(const std::type_info* const* types, const void* const* values, int count) {
        if (count != this->m_arity) throw ArgumentNumberException(__LINE__, this->m_arity);
        if (!traits::match(types, count))
            throw MethodInvokeException("call of " + this->m_name +
                                        " with other types than it has: " + this->signature());
        return apply(values, std::index_sequence_for<P...>());
    }
    virtual ReturnType call(archive::iarchive& in, archive::oarchive& out) {
        return call_encoded(in, out, std::integral_constant<bool, traits::can_cross>());
    }
    virtual ReturnType call(std::vector<opros_params>& params, opros_params& result) {
        return call_with(params, result, std::index_sequence_for<P...>());
    }
    virtual bool describe(archive::iarchive& arguments, archive::iarchive& result) {
        return describer<traits::can_cross, bare<R>, P...>::describe(arguments, result);
    }
    virtual std::vector<const std::type_info*> types() const { return traits::list(); }

  private:
    typedef method_types<R, P...> traits;

    /// `values` are the addresses of the arguments, whose types have been checked.
    template <std::size_t... I>
    R apply(const void* const* values, std::index_sequence<I...>) {
        static_cast<void>(values);
        return m_function(argument<P>(values[I]).get()...);
    }

    // An argument or result that cannot be archived.
    ReturnType call_encoded(archive::iarchive&, archive::oarchive&, std::false_type) {
        return OPROS_UNSUPPORTED_METHOD;
    }
    ReturnType call_encoded(archive::iarchive& in, archive::oarchive& out, std::true_type) {
        typename traits::arguments arguments;
        load(in, arguments, std::index_sequence_for<P...>());
        encode_result(out, arguments, std::is_void<R>());
        return OPROS_SUCCESS;
    }
    template <std::size_t... I>
    void load(archive::iarchive& in, typename traits::arguments& arguments, std::index_sequence<I...>) {
        static_cast<void>(in);
        static_cast<void>(arguments);
        const int in_order[] = {0, (in >> std::get<I>(arguments), 0)...};
        static_cast<void>(in_order);
    }
    template <std::size_t... I>
    R apply_tuple(typename traits::arguments& arguments, std::index_sequence<I...>) {
        static_cast<void>(arguments);
        const void* const values[] = {static_cast<const void*>(&std::get<I>(arguments))..., 0};
        return apply(values, std::index_sequence_for<P...>());
    }
    void encode_result(archive::oarchive&, typename traits::arguments& arguments, std::true_type) {
        apply_tuple(arguments, std::index_sequence_for<P...>());
    }
    void encode_result(archive::oarchive& out, typename traits::arguments& arguments, std::false_type) {
        out << apply_tuple(arguments, std::index_sequence_for<P...>());
    }

    template <std::size_t... I>
    ReturnType call_with(std::vector<opros_params>& params, opros_params& result, std::index_sequence<I...>) {
        if (params.size() != sizeof...(P)) return OPROS_BAD_INPUT_PARAMETER;
        const void* const values[] = {static_cast<const void*>(opros_params_cast<bare<P>>(&params[I]))...,
                                      &params};
        for (const void* value : values)
            if (!value) return OPROS_BAD_INPUT_PARAMETER;
        store_result(values, result, std::is_void<R>());
        return OPROS_SUCCESS;
    }
    void store_result(const void* const* values, opros_params&, std::true_type) {
        apply(values, std::index_sequence_for<P...>());
    }
    void store_result(const void* const* values, opros_params& result, std::false_type) {
        result = apply(values, std::index_sequence_for<P...>());
    }

    Function m_function;
};

// The functions that a bound_method calls.
template <typename R, typename C, typename Pointer, typename... P>
struct member_call {
    Pointer function;
    C* object;
    R operator()(P... p) const { return (object->*function)(std::forward<P>(p)...); }
};
template <typename R, typename... P>
struct free_call {
    R (*function)(P...);
    R operator()(P... p) const { return function(std::forward<P>(p)...); }
};

} // namespace detail
} // namespace opros

/// A new method, for ServicePortInterface::addMethod(), that calls the member function on the object, which must
/// outlive it, or a function. The call type of a provided method has no effect: that of the required one counts.
template <typename R, typename C, typename D, typename... P>
Method* makeProvidedMethod(R (C::*function)(P...), D* object, const char* name,
                           const int& callType = METHOD_BLOCKING) {
    typedef opros::detail::member_call<R, C, R (C::*)(P...), P...> call;
    return new opros::detail::bound_method<call, R, P...>(call{function, object}, name, callType);
}
template <typename R, typename C, typename D, typename... P>
Method* makeProvidedMethod(R (C::*function)(P...) const, D* object, const char* name,
                           const int& callType = METHOD_BLOCKING) {
    typedef opros::detail::member_call<R, C, R (C::*)(P...) const, P...> call;
    return new opros::detail::bound_method<call, R, P...>(call{function, object}, name, callType);
}
template <typename R, typename... P>
Method* makeProvidedMethod(R (*function)(P...), const char* name, const int& callType = METHOD_BLOCKING) {
    typedef opros::detail::free_call<R, P...> call;
    return new opros::detail::bound_method<call, R, P...>(call{function}, name, callType);
}

#endif
