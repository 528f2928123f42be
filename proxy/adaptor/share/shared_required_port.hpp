// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/adaptor/service/mirror_provided_port.hpp"
#include "proxy/link/protocol/control.hpp"

#include <ProvidedServicePort.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace tandem::adaptor {

/// Connected with a required service port of a shared component: a provider on the RTM side, whose interface is known only
/// after the peer has sent it. Until then calls throw MethodInvokeException, "not ready".
class SharedRequiredPort final : public ProvidedServicePort {
  public:
    /// `port` is the required port's entry in the port table. The link must outlive this port.
    SharedRequiredPort(link::Port port, link::Link& link, std::chrono::milliseconds call_timeout)
        : port_(std::move(port)), link_(link), call_timeout_(call_timeout) {}

    const std::string& port() const { return port_.name; }
    /// Sets the operations of the interface; none if the peer does not know its IDL: then the methods describe themselves.
    /// Logs a line for each method that fits none. [worker-thread]
    void bind(const link::control::ServiceBinding& binding);

    bool isDynamic() const override { return true; }
    /// Stores the method. A mismatch is reported when the peer has sent its operations.
    std::string bindMethod(Method* required) override;
    ReturnType callService(std::string& name, std::vector<opros_params>& arguments,
                           opros_params& result) override;
    using ProvidedServicePort::callService;
    ReturnType callEncoded(Method& required, const CallValue* arguments, int count,
                           const CallValue& result) override;

  private:
    MirrorProvidedPort& mirror(const std::string& method);

    const link::Port port_;
    link::Link& link_;
    const std::chrono::milliseconds call_timeout_;
    std::mutex mutex_;
    std::vector<Method*> methods_; ///< of the component's port, which outlives the connection
    std::vector<link::ServiceOperation> operations_;
    /// The last one is in use. The earlier ones are kept, because calls under way may use them.
    std::vector<std::unique_ptr<MirrorProvidedPort>> mirrors_;
    std::atomic<MirrorProvidedPort*> current_{nullptr};
};

} // namespace tandem::adaptor
