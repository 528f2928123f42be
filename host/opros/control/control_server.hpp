// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/local/request_server.hpp"
#include "host/opros/control/application_control.hpp"

#include <chrono>
#include <memory>
#include <string>

namespace tandem::control {

/// The socket of this host for `tandem opros`. A host without a folder for its socket runs without it, after one line.
/// [main-thread]
class ControlServer {
  public:
    /// Answers requests about the application from now on.
    ControlServer(engine::Application& application, const std::string& profile);
    /// No longer answers requests for properties. Call it before the application is shut down.
    void close() { control_->close(); }
    /// Ends the socket and waits for the requests that are still running. Call it when the application is shut down.
    /// Returns false if one still runs, because a component hangs: the application must then not be unloaded.
    bool stop_within(std::chrono::nanoseconds timeout);

  private:
    std::shared_ptr<ApplicationControl> control_; ///< shared with the requests
    std::unique_ptr<local::RequestServer> server_;
};

} // namespace tandem::control
