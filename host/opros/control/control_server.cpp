// SPDX-License-Identifier: Apache-2.0
#include "host/opros/control/control_server.hpp"

#include "host/local/local_endpoint.hpp"
#include "host/log/log.hpp"

#include <stdexcept>

namespace tandem::control {

ControlServer::ControlServer(engine::Application& application, const std::string& profile)
    : control_(std::make_shared<ApplicationControl>(application, profile)) {
    local::RequestHandler handler;
    handler.answer = [control = control_](const std::string& request) { return control->answer(request); };
    handler.time_limit = ApplicationControl::time_limit;
    handler.late_reply = [control = control_](const std::string& request) {
        return control->late_reply(request);
    };
    handler.may_hang = ApplicationControl::runs_callback;
    handler.refusal =
        R"({"error": "opros_host has too many requests that have not ended; a component hangs"})";
    try {
        server_ = std::make_unique<local::RequestServer>(local::make_local_endpoint(local::opros_endpoint),
                                                         std::move(handler));
    } catch (const std::runtime_error& error) {
        log::warn("tandem opros cannot reach this host: {}", error.what());
    }
}

bool ControlServer::stop_within(std::chrono::nanoseconds timeout) {
    if (server_ && !server_->stop_within(timeout)) return false;
    server_.reset();
    control_.reset();
    return true;
}

} // namespace tandem::control
