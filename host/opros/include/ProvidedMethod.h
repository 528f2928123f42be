// SPDX-License-Identifier: Apache-2.0
// Methods that a component provides. Generated code creates one with makeProvidedMethod(), keeps it as a Method* and
// calls it as a ProvidedMethod<R>. The classes form one chain of single inheritance, so that the address is the same.
#ifndef PROVIDEDMETHOD_H_
#define PROVIDEDMETHOD_H_

#include <ArgumentNumberException.h>
#include <MethodInvokeException.h>
#include <MethodTypes.h>
#include <ProvidedMethodInterface.h>

#include <cstddef>

namespace opros {
namespace detail {

/// An encoded call with all arguments in one archive, one after the other. Only the result is written.
class stream_call : public EncodedCall {
  public:
    stream_call(archive::iarchive& in, archive::oarchive& out) : m_in(in), m_out(out) {}
    virtual archive::iarchive* argument(int) { return &m_in; }
    virtual archive::oarchive& result() { return m_out; }
    virtual archive::oarchive* written_argument(int) { return 0; }

  private:
    archive::iarchive& m_in;
    archive::oarchive& m_out;
};

} // namespace detail
} // namespace opros

/// A provided method with only its result type known. Created by makeProvidedMethod().
template <typename RetType>
class ProvidedMethod : public ProvidedMethodInterface {
  public:
    ProvidedMethod(const char* name, int callType, const opros::detail::MethodSignature& signature)
        : ProvidedMethodInterface(name), m_signature(signature), m_returnType(getTypeName<RetType>()),
          m_callType(callType) {}
    virtual std::string& getReturnType() { return m_returnType; }
    virtual int getArity() { return m_signature.arity; }
    virtual int getCallType() { return m_callType; }
    virtual bool describe(MethodDescription& description) { return m_signature.describe(description); }
    virtual std::vector<const std::type_info*> types() const { return m_signature.list(); }

    /// Calls the method. The arguments must have exactly the declared types, apart from const and reference;
    /// otherwise throws ArgumentNumberException or MethodInvokeException. A method that takes a reference writes to
    /// the caller's variable, or to a copy if the variable is const.
    template <typename... P>
    RetType operator()(P&&... arguments) {
        const std::type_info* const types[] = {&typeid(opros::detail::bare<P>)..., 0};
        const void* const values[] = {static_cast<const void*>(&arguments)..., 0};
        const bool writable[] = {opros::detail::is_writable<P>::value..., false};
        if (!m_signature.match(types, static_cast<int>(sizeof...(P)))) refuse(static_cast<int>(sizeof...(P)));
        return apply(values, writable);
    }

    using ProvidedMethodInterface::call;
    virtual ReturnType call(opros::archive::iarchive& in, opros::archive::oarchive& out) {
        opros::detail::stream_call both(in, out);
        return call(both);
    }

  protected:
    /// Calls the function. `values` are the addresses of the arguments, whose types have been checked. `writable`
    /// says for each argument whether the caller's value may be written.
    virtual RetType apply(const void* const* values, const bool* writable) = 0;

    // Use arguments that belong to this call: the method may write all of them.
    void encode_result(EncodedCall&, const void* const* values, std::true_type) {
        apply(values, m_signature.writable);
    }
    void encode_result(EncodedCall& call, const void* const* values, std::false_type) {
        // Called first, so that an exception leaves no partial reply.
        const opros::detail::bare<RetType> result = apply(values, m_signature.writable);
        call.result() << result;
    }
    void store_result(const void* const* values, opros_params&, std::true_type) {
        apply(values, m_signature.writable);
    }
    void store_result(const void* const* values, opros_params& result, std::false_type) {
        result = apply(values, m_signature.writable);
    }

    const opros::detail::MethodSignature m_signature; // a copy: calls read it beside the object
    std::string m_returnType;
    const int m_callType;

  private:
    [[noreturn]] void refuse(int count) {
        if (count != m_signature.arity) throw ArgumentNumberException(__LINE__, m_signature.arity);
        refuse_types();
    }
};

namespace opros {
namespace detail {

/// Returns the address of a value in an opros_params in the form that the method takes, or NULL if the type differs.
template <typename P, bool by_pointer = passing<P>::by_pointer>
struct param_address {
    const void* find(opros_params& param) { return opros_params_cast<bare<P>>(&param); }
};
template <typename P>
struct param_address<P, true> {
    bare<P> pointer = 0;
    const void* find(opros_params& param) {
        pointer = opros_params_cast<typename passing<P>::stored>(&param);
        return pointer ? &pointer : 0;
    }
};

// Read an argument before the call, or write it after the call, if the caller has an archive for it.
template <typename T>
int load_value(archive::iarchive* in, T& value) {
    if (in) *in >> value;
    return 0;
}
template <typename T>
int save_value(archive::oarchive* out, T& value) {
    if (out) *out << value;
    return 0;
}

/// A provided method with all types known, and the function that it calls.
template <typename Function, typename R, typename... P>
class bound_method : public ProvidedMethod<R> {
  public:
    bound_method(const Function& function, const char* name, int callType)
        : ProvidedMethod<R>(name, callType, signature_of<R, P...>()), m_function(function) {}

    using ProvidedMethod<R>::call;
    virtual ReturnType call(EncodedCall& values) {
        return call_encoded(values, std::integral_constant<bool, method_crosses<R, P...>::value>());
    }
    virtual ReturnType call(std::vector<opros_params>& params, opros_params& result) {
        if (params.size() != sizeof...(P)) return OPROS_BAD_INPUT_PARAMETER;
        return call_with(params, result, std::index_sequence_for<P...>(), param_address<P>()...);
    }

  private:
    virtual R apply(const void* const* values, const bool* writable) {
        return apply_each(values, writable, std::index_sequence_for<P...>());
    }
    template <std::size_t... I>
    R apply_each(const void* const* values, const bool* writable, std::index_sequence<I...>) {
        static_cast<void>(values);
        static_cast<void>(writable);
        return m_function(argument<P>(values[I], writable[I]).get()...);
    }

    // For an argument or result that cannot be archived.
    ReturnType call_encoded(EncodedCall&, std::false_type) { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType call_encoded(EncodedCall& call, std::true_type) {
        return call_slots(call, std::index_sequence_for<P...>(), argument_slot<P>()...);
    }
    // The slots are parameters: a std::tuple of them caused a quarter of all functions compiled for a method.
    template <std::size_t... I>
    ReturnType call_slots(EncodedCall& call, std::index_sequence<I...>, argument_slot<P>&&... slots) {
        const int loaded[] = {0, load_value(call.argument(static_cast<int>(I)), slots.value)...};
        const void* const values[] = {slots.address()..., 0};
        this->encode_result(call, values, std::is_void<R>());
        const int saved[] = {0, (passing<P>::writable
                                     ? save_value(call.written_argument(static_cast<int>(I)), slots.value)
                                     : 0)...};
        static_cast<void>(loaded);
        static_cast<void>(saved);
        return OPROS_SUCCESS;
    }

    template <std::size_t... I>
    ReturnType call_with(std::vector<opros_params>& params, opros_params& result, std::index_sequence<I...>,
                         param_address<P>&&... addresses) {
        const void* const values[] = {addresses.find(params[I])..., &params};
        for (const void* value : values)
            if (!value) return OPROS_BAD_INPUT_PARAMETER;
        this->store_result(values, result, std::is_void<R>());
        return OPROS_SUCCESS;
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

/// Returns a new method, for ServicePortInterface::addMethod(), that calls a function, or a member function on the
/// object. The object must outlive the method. A provided method's call type has no effect: the required method's
/// counts.
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
