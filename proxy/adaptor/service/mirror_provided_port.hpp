// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/adaptor/archive/refusal_record.hpp"
#include "proxy/adaptor/names/peer_names.hpp"
#include "proxy/adaptor/service/method_types.hpp"
#include "proxy/link/link.hpp"
#include "proxy/link/protocol/operation_table.hpp"
#include "proxy/link/registry.hpp"

#include <MethodInvokeException.h>
#include <ProvidedServicePort.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

namespace tandem::adaptor {

/// Mirrors a service port that the peer provides. A call of an OPRoS component crosses the link in the calling thread and
/// waits for the reply, at most `call_timeout`. Oneway operations and non-blocking methods without a result do not wait. A
/// failure is thrown as MethodInvokeException, one line. The component's own serialization encodes the arguments; no stub
/// is compiled.
class MirrorProvidedPort final : public ProvidedServicePort, public RefusalRecord {
  public:
    MirrorProvidedPort(link::Port peer, link::Link& link, std::chrono::milliseconds call_timeout,
                       PeerNames names = {});

    bool isDynamic() const override { return true; }
    /// Called when the host connects this port, once for each method of the required port. Returns an empty string, or one
    /// line if the peer has no operation that fits; calls of this method then throw this line.
    std::string bindMethod(Method* required) override;
    ReturnType callService(std::string& name, std::vector<opros_params>& arguments,
                           opros_params& result) override;
    using ProvidedServicePort::callService;
    ReturnType callEncoded(Method& required, const CallValue* arguments, int count,
                           const CallValue& result) override;

  private:
    /// A method of the connected port.
    struct Binding {
        std::string method, operation; ///< operation: the peer's name of the method
        wire::Operation types;
        link::RequestHead request_head;
        Directions directions;
        bool waits = true;                    ///< for the reply
        std::string problem;                  ///< why it cannot be called; empty if it can
        std::optional<wire::Type> pictures{}; ///< the reply, if picture_error() must check it

        bool is_same(const Binding& other) const;
    };
    Binding make_binding(Method& required) const;
    std::string why_unknown(const std::string& method, const MethodTypes& types) const;
    link::ReplyView make_call(const Binding& binding, std::span<const CallValue> arguments,
                              wire::MessageBuffer& memory);
    MethodInvokeException refused_results(const Binding& binding, std::string_view why) const;
    ReturnType call(const Binding& binding, std::span<const CallValue> arguments, const CallValue& result);

    const link::Port peer_;
    const link::OperationTable operations_;
    link::Link& link_;
    const std::chrono::milliseconds call_timeout_;
    const PeerNames names_;
    link::Registry<const Binding> current_; ///< by method name, and by the id of the calling method
    std::vector<std::unique_ptr<const Binding>> bindings_; ///< also replaced ones: a call may use them
};

} // namespace tandem::adaptor
