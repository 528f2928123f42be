// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <ProvidedServicePort.h>
#include <ServicePortConnector.h>

#include <string>
#include <vector>

/// Calls a dynamic provided port as the host's connector does.
struct ProvidedPortConnector : ServicePortConnector {
    explicit ProvidedPortConnector(ProvidedServicePort& port) : port(port) {}
    ReturnType requestService(const std::string& name, std::vector<opros_params>& params,
                              opros_params& result, int) override {
        std::string method = name;
        return port.callService(method, params, result);
    }
    ReturnType requestEncoded(Method& method, const CallValue* arguments, int count,
                              const CallValue& result) override {
        return copies ? OPROS_UNSUPPORTED_METHOD : port.callEncoded(method, arguments, count, result);
    }
    ReturnType responseService(std::string&, std::string&, std::string&) override {
        return OPROS_UNSUPPORTED_METHOD;
    }
    ProvidedServicePort& port;
    bool copies = false; ///< of the values, as a connector that has requestService() only
};
