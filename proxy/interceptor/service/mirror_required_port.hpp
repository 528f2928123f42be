// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/process/log_throttle.hpp"
#include "proxy/interceptor/corba/generic_servant.hpp"
#include "proxy/link/link.hpp"
#include "proxy/link/protocol/control.hpp"
#include "proxy/link/protocol/operation_table.hpp"

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace tandem::interceptor {

/// Mirrors a service interface that the RTC requires and an OPRoS component provides: a CORBA object whose calls cross the
/// link, without a compiled skeleton. A failed call throws the user exception of the OPRoS method, if the operation
/// declares it, or a CORBA system exception: TIMEOUT, TRANSIENT (not ready), COMM_FAILURE (peer gone), NO_RESOURCES (too
/// many calls), BAD_OPERATION, BAD_PARAM, MARSHAL (a value cannot cross), or UNKNOWN. Its text is in the log.
class MirrorRequiredPort final : private CallTarget {
  public:
    MirrorRequiredPort(link::Port port, link::Link& link, std::chrono::milliseconds call_timeout);

    GenericServant& servant() { return servant_; }
    const link::Port& port() const { return port_; }
    /// Sets the operations that the OPRoS component provides. Unless there are none, calls are ready from now on.
    /// [worker-thread]
    void bind(const link::control::ServiceBinding& binding);
    /// Called when nobody provides the interface any more. [any-thread]
    void unbind() { ready_ = false; }

  private:
    // CallTarget, in ORB threads or the calling component's thread.
    const wire::Operation* find_operation(const char* name) override;
    void unknown_operation(const char* name) override;
    void put_head(const wire::Operation&, wire::CdrWriter& out) override;
    std::span<const std::byte> call(const char* name, const wire::Operation&,
                                    std::span<const std::byte> request, wire::MessageBuffer& memory) override;
    void value_refused(const char* name, const char* what, const std::string& reason) override;
    bool may_be(const char* repository_id) const override;
    bool is_ready() const override { return ready_ && link_.is_up(); }

    /// An operation that can be called, or the reason why it cannot.
    struct Callable : wire::Operation {
        std::string name, problem;
        link::RequestHead head;
    };
    /// The operations that the OPRoS component provides, as far as they are known.
    struct Table {
        Table(const std::string& port, const std::vector<link::ServiceOperation>& operations);
        const link::OperationTable operations;
        std::vector<Callable> callables;
    };
    void add_table(std::unique_ptr<const Table> table);
    [[noreturn]] void refuse(const Callable& callable);
    void log_failure(const char* name, const std::string& text);
    [[noreturn]] void throw_failure(const char* name, const wire::Operation&, const link::Reply&);

    const link::Port port_;
    link::Link& link_;
    const std::chrono::milliseconds call_timeout_;
    std::atomic<bool> ready_{false};
    std::atomic<const Table*> table_{nullptr};
    std::mutex mutex_; ///< the one below
    /// The last one is in use. The replaced ones are kept, because calls under way may use them.
    std::vector<std::unique_ptr<const Table>> tables_;
    process::LogThrottle failed_calls_;
    GenericServant servant_;
};

} // namespace tandem::interceptor
