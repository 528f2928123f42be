// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/connect/service_connector.hpp"

#include "host/crash/callback_scope.hpp"

#include <MethodInvokeException.h>

namespace tandem::engine {
namespace {

/// The common part of the two kinds.
class Connector : public ServicePortConnector {
  public:
    Connector(ProvidedServicePort& provided, ComponentHost& provider)
        : provided_(provided), provider_(provider) {}
    ReturnType responseService(std::string&, std::string&, std::string&) override {
        return OPROS_UNSUPPORTED_METHOD;
    }

  protected:
    ProvidedServicePort& provided_;
    ComponentHost& provider_;
};

/// The method runs in the caller's thread, inside a callback of the caller.
class DirectConnector : public Connector {
  public:
    using Connector::Connector;
    ReturnType requestService(const std::string& name, std::vector<opros_params>& params,
                              opros_params& result, int) override {
        std::string method = name;
        const crash::CallbackScope scope(nullptr, provider_.name().c_str(), name.c_str(), provider_.code());
        return check(name, provided_.callService(method, params, result));
    }
    ReturnType requestEncoded(Method& method, const CallValue* arguments, int count,
                              const CallValue& result) override {
        const std::string& name = method.getName();
        const crash::CallbackScope scope(nullptr, provider_.name().c_str(), name.c_str(), provider_.code());
        const ReturnType code = provided_.callEncoded(method, arguments, count, result);
        return code == OPROS_UNSUPPORTED_METHOD ? code : check(name, code);
    }

  private:
    ReturnType check(const std::string& name, ReturnType code) {
        if (code == OPROS_SUCCESS) [[likely]]
            return code;
        throw MethodInvokeException("call of " + provider_.name() + "'s " + name + " failed with code " +
                                    std::to_string(code));
    }
};

class QueuedConnector : public Connector {
  public:
    QueuedConnector(ProvidedServicePort& provided, ComponentHost& provider) : Connector(provided, provider) {
        provider.task_queue()->start();
    }

    ReturnType requestService(const std::string& name, std::vector<opros_params>& params, opros_params&,
                              int) override {
        const bool accepted = provider_.task_queue()->submit([this, method = name, params]() mutable {
            // The component has stopped or failed since the call was accepted. The call is dropped, because its caller
            // does not wait.
            if (!provider_.is_active()) return;
            provider_.run_guarded(method.c_str(), [&] {
                opros_params none;
                provided_.callService(method, params, none);
            });
        });
        if (accepted) return OPROS_SUCCESS;
        throw MethodInvokeException("call of " + provider_.name() + "'s " + name +
                                    ": too many calls are waiting");
    }
};

} // namespace

std::unique_ptr<ServicePortConnector> make_direct_connector(ProvidedServicePort& provided,
                                                            ComponentHost& provider) {
    return std::make_unique<DirectConnector>(provided, provider);
}

std::unique_ptr<ServicePortConnector> make_queued_connector(ProvidedServicePort& provided,
                                                            ComponentHost& provider) {
    return std::make_unique<QueuedConnector>(provided, provider);
}

} // namespace tandem::engine
