// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/connect/reported_port.hpp"

#include "host/crash/callback_scope.hpp"

#include <ProvidedMethodInterface.h>

namespace tandem::engine {
namespace {

/// Returns the name under which the component has the port. The port itself may have none.
std::string name_in(Component& component, const Port& port) {
    for (const std::string& name : component.getPortNames(OPROS_SERVICE))
        if (component.getPort(name) == &port) return name;
    return "";
}

/// Calls the method of a component.
class ReportedMethod final : public ProvidedMethodInterface {
  public:
    /// `port`: its name in crash reports.
    ReportedMethod(const std::string& name, Method& method, const char* port, ComponentHost& provider)
        : ProvidedMethodInterface(name), method_(method), callee_(method.provided()), port_(port),
          provider_(provider) {}

    std::string& getName() override { return method_.getName(); }
    std::string& getReturnType() override { return method_.getReturnType(); }
    int getArity() override { return method_.getArity(); }
    int getCallType() override { return method_.getCallType(); }
    bool describe(MethodDescription& description) override { return method_.describe(description); }
    std::vector<const std::type_info*> types() const override { return method_.types(); }
    ProvidedMethodInterface* provided() override { return callee_ ? this : nullptr; }
    ReturnType call(EncodedCall& call) override {
        return report([&] { return callee_->call(call); });
    }
    ReturnType call(opros::archive::iarchive& in, opros::archive::oarchive& out) override {
        return report([&] { return callee_->call(in, out); });
    }
    ReturnType call(std::vector<opros_params>& params, opros_params& result) override {
        return report([&] { return callee_->call(params, result); });
    }

  private:
    template <class Call>
    ReturnType report(Call&& call) {
        const crash::CallbackScope scope(nullptr, provider_.name().c_str(), m_name.c_str(), provider_.code());
        const crash::PortScope port(port_);
        return call();
    }

    Method& method_;
    ProvidedMethodInterface* const callee_; ///< null: the method cannot be called
    const char* const port_;
    ComponentHost& provider_;
};

} // namespace

ReportedPort::ReportedPort(ProvidedServicePort& port, ComponentHost& provider)
    : ProvidedServicePort(name_in(provider.component(), port)), port_(port), provider_(provider) {
    for (auto at = port.getFirst(); at != port.getEnd(); ++at)
        addMethod(at->first, new ReportedMethod(at->first, *at->second, m_name.c_str(), provider));
}

// A component may override this function, for methods that it has no objects for.
ReturnType ReportedPort::callService(const std::string& name, EncodedCall& call) {
    const crash::CallbackScope scope(nullptr, provider_.name().c_str(), name.c_str(), provider_.code());
    const crash::PortScope port(m_name.c_str());
    return port_.callService(name, call);
}

} // namespace tandem::engine
