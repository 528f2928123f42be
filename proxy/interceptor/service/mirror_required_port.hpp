// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/process/log_throttle.hpp"
#include "host/rt/short_mutex.hpp"
#include "proxy/interceptor/corba/generic_servant.hpp"
#include "proxy/link/link.hpp"
#include "proxy/link/protocol/control.hpp"
#include "proxy/link/protocol/operation_table.hpp"

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

namespace tandem::interceptor {

/// Mirrors a service interface that the RTC requires and an OPRoS component provides: a CORBA object whose
/// calls cross the link, without a compiled skeleton. A failed call is the user exception that the OPRoS method
/// threw, if the operation declares it, or a CORBA system exception: TIMEOUT, TRANSIENT (not ready), COMM_FAILURE
/// (peer gone), NO_RESOURCES (too many calls), BAD_OPERATION, BAD_PARAM, or UNKNOWN; their text is in the log.
class MirrorRequiredPort final : private CallTarget {
  public:
    MirrorRequiredPort(link::Port port, link::Link& link, std::chrono::milliseconds call_timeout);

    GenericServant& servant() { return servant_; }
    const link::Port& port() const { return port_; }
    /// Learns what the OPRoS component provides: the calls are ready from now on if that is anything. [worker-thread]
    void bind(const link::control::ServiceBinding& binding);
    /// Nobody provides it any more. [any-thread]
    void unbind() { ready_ = false; }

  private:
    // CallTarget, in ORB threads or the calling component's own.
    const wire::Operation* find_operation(const char* name) override;
    std::vector<std::byte> call(const char* name, const wire::Operation&,
                                std::span<const std::byte>) override;
    bool is_ready() const override { return ready_ && link_.is_up(); }

    void add_table(std::unique_ptr<const link::OperationTable> table); ///< with mutex_ held
    const link::RequestHead& find_head(const wire::Operation& operation);
    [[noreturn]] void throw_failure(const char* name, const wire::Operation&, const link::Reply&);

    const link::Port port_;
    link::Link& link_;
    const std::chrono::milliseconds call_timeout_;
    std::atomic<bool> ready_{false};
    rt::ShortMutex mutex_; ///< the two below
    /// The last one is in use. Those that it replaced are kept, because calls that are being executed may still use
    /// them.
    std::vector<std::unique_ptr<const link::OperationTable>> tables_;
    std::unordered_map<const wire::Operation*, const link::RequestHead> request_heads_; ///< of all tables
    process::LogThrottle failed_calls_;
    GenericServant servant_;
};

} // namespace tandem::interceptor
