// SPDX-License-Identifier: Apache-2.0
// Methods that a component requires. Generated code creates one with makeRequiredMethod(), keeps it as a Method* and
// calls it as a RequiredMethod<R> (see ProvidedMethod.h).
#ifndef REQUIREDMETHOD_H_
#define REQUIREDMETHOD_H_

#include <ArgumentNumberException.h>
#include <MethodInvokeException.h>
#include <MethodTypes.h>
#include <ProvidedMethod.h>
#include <RequiredMethodInterface.h>

#include <atomic>

/// A required method with only its result type known. Before the component starts, the host connects it to a provided
/// method of the same application (a function call) or to a connector.
template <typename RetType>
class RequiredMethod : public RequiredMethodInterface {
  public:
    RequiredMethod(const std::string& name, int arity, int callType)
        : RequiredMethod(name, arity, callType, 0) {}
    /// Ours: a method with known argument types, which calls and peers must then match.
    RequiredMethod(const char* name, int callType, const opros::detail::MethodSignature& signature)
        : RequiredMethod(name, signature.arity, callType, &signature) {}
    virtual std::string& getReturnType() { return m_returnType; }
    virtual int getArity() { return m_arity; }
    virtual int getCallType() { return m_callType; }
    virtual bool describe(MethodDescription& description) {
        return m_signature && m_signature->describe(description);
    }
    virtual std::vector<const std::type_info*> types() const {
        return m_signature ? m_signature->list() : std::vector<const std::type_info*>();
    }

    virtual ReturnType Disconnect() {
        m_peer = 0;
        m_con = 0;
        return OPROS_SUCCESS;
    }
    // Connecting to one kind of peer disconnects from the other.
    virtual ReturnType Connect(Method* peer) {
        if (!peer || !same_types(*peer)) return OPROS_BAD_INPUT_PARAMETER;
        m_peer = static_cast<ProvidedMethod<RetType>*>(static_cast<ProvidedMethodInterface*>(peer));
        m_con = 0;
        return OPROS_SUCCESS;
    }
    virtual ReturnType Connect(ServicePortConnector* peer) {
        m_peer = 0;
        m_con = peer;
        return OPROS_SUCCESS;
    }

    /// Calls the peer in this thread, or lets the connector call it. Writes back arguments that the method takes by
    /// reference or pointer. Throws MethodInvokeException without a peer, if the connection fails, or if the
    /// arguments do not exactly have the peer's types.
    template <typename... P>
    RetType operator()(P&&... arguments) {
        if (ProvidedMethod<RetType>* peer = m_peer.load(std::memory_order_acquire))
            return (*peer)(std::forward<P>(arguments)...);
        return request(std::is_void<RetType>(), std::forward<P>(arguments)...);
    }

  protected:
    // At most one of them is not NULL. The host may connect and disconnect the method while it is called.
    std::atomic<ProvidedMethod<RetType>*> m_peer;
    std::atomic<ServicePortConnector*> m_con;
    const int m_arity;
    const int m_callType;
    std::string m_returnType;

  private:
    RequiredMethod(const std::string& name, int arity, int callType,
                   const opros::detail::MethodSignature* signature)
        : RequiredMethodInterface(name), m_peer(0), m_con(0), m_arity(arity), m_callType(callType),
          m_returnType(getTypeName<RetType>()), m_signature(signature) {}

    bool accepts(const std::type_info* const* types, int count) const {
        return m_signature ? m_signature->match(types, count) : count == m_arity;
    }

    /// Returns true if the peer's result and arguments have the types of this method. If this method does not know
    /// its argument types, compares only their number.
    bool same_types(const Method& peer) const {
        const std::vector<const std::type_info*> mine = types(), theirs = peer.types();
        if (theirs.empty() || *theirs[0] != typeid(RetType)) return false;
        if (mine.empty()) return static_cast<int>(theirs.size()) == m_arity + 1;
        if (mine.size() != theirs.size()) return false;
        for (std::size_t i = 0; i < mine.size(); ++i)
            if (*mine[i] != *theirs[i]) return false;
        return true;
    }

    // Calls through a connector. Arguments and result cross as values of known types, and a pointer crosses as the
    // value that it points to. Returns false if the connector needs copies of the values.
    template <typename... P>
    bool send_encoded(const CallValue& result, P&&... arguments) {
        const std::type_info* const types[] = {&typeid(opros::detail::bare<P>)..., 0};
        if (!accepts(types, static_cast<int>(sizeof...(P)))) refuse_types();
        const CallValue values[] = {opros::detail::call_value<P>::of(arguments)..., result};
        const ReturnType code =
            connector().requestEncoded(*this, values, static_cast<int>(sizeof...(P)), result);
        if (code == OPROS_UNSUPPORTED_METHOD) return false;
        if (code != OPROS_SUCCESS) refuse_call(code);
        return true;
    }
    ServicePortConnector& connector() const {
        if (ServicePortConnector* connected = m_con.load(std::memory_order_acquire)) return *connected;
        throw MethodInvokeException("required method " + m_name + " is not connected");
    }

    // Calls through a connector with copies of the values.
    template <typename... P>
    void send(opros_params& result, P&&... arguments) {
        std::vector<opros_params> params;
        params.reserve(sizeof...(P));
        const int in_order[] = {0, (opros::detail::call_param<P>::add(params, arguments), 0)...};
        static_cast<void>(in_order);
        const ReturnType code = connector().requestService(m_name, params, result, m_callType);
        if (code != OPROS_SUCCESS) refuse_call(code);
        int index = 0;
        const int back[] = {0, write_back<P>(params, index++, arguments)...};
        static_cast<void>(back);
    }
    template <typename A, typename T>
    int write_back(std::vector<opros_params>& params, int index, T& argument) {
        if (m_signature && m_signature->writable[index])
            opros::detail::call_param<A>::write_back(argument, params[static_cast<std::size_t>(index)],
                                                     opros::detail::is_writable<A>());
        return 0;
    }

    // Not inline: a call inside the application then takes 46 instructions instead of 62 (tandem-bench, path), because
    // it saves no registers for these functions.
    template <typename... P>
    [[gnu::noinline]] RetType request(std::true_type, P&&... arguments) {
        if (send_encoded(opros::detail::no_value(), std::forward<P>(arguments)...)) return;
        opros_params none;
        send(none, std::forward<P>(arguments)...);
    }
    template <typename... P>
    [[gnu::noinline]] RetType request(std::false_type, P&&... arguments) {
        RetType own = RetType();
        if (send_encoded(opros::detail::call_value<RetType&>::of(own), std::forward<P>(arguments)...))
            return own;
        opros_params result;
        result.setType(static_cast<RetType*>(0));
        send(result, std::forward<P>(arguments)...);
        RetType* value = opros_params_cast<RetType>(&result);
        if (!value)
            throw MethodInvokeException("call of " + m_name + " came back with a result of another type");
        return *value;
    }

    const opros::detail::MethodSignature* m_signature; ///< NULL: the argument types are unknown
};

/// Returns a new method, for ServicePortInterface::addMethod(), with the types of the member function. That function
/// belongs to the generated port and calls this method; it is not called here.
template <typename R, typename C, typename... P>
Method* makeRequiredMethod(R (C::*)(P...), const char* name, const int& callType = METHOD_BLOCKING) {
    return new RequiredMethod<R>(name, callType, opros::detail::signature_of<R, P...>());
}
template <typename R, typename C, typename... P>
Method* makeRequiredMethod(R (C::*)(P...) const, const char* name, const int& callType = METHOD_BLOCKING) {
    return new RequiredMethod<R>(name, callType, opros::detail::signature_of<R, P...>());
}

#endif
