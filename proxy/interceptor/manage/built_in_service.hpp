// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"
#include "proxy/link/protocol/reply.hpp"
#include "proxy/link/protocol/request.hpp"
#include "proxy/wire/cdr.hpp"

#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace tandem::interceptor {

/// Why an operation failed, in one line. The caller's exception has this text.
class OperationFailed : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// A service that this process provides to the peer. Its operations take and return strings.
class BuiltInService {
  public:
    using Strings = std::vector<std::string>;
    /// Throws OperationFailed, another std::exception or CORBA::Exception.
    using Operation = std::function<Strings(const Strings& arguments)>;

    explicit BuiltInService(const std::string& name);

    /// Adds an operation. `signature` (arguments:result) consists of `s`; the last argument and the result may be `as`. The
    /// elements of an `as` argument follow the other arguments.
    void add(const std::string& name, const std::string& signature, Operation operation);
    const link::Port& port() const { return port_; }
    /// Executes one call of the peer. Failures are replies. [worker-thread]
    link::Reply serve(const link::Request& request) const;

  private:
    link::Port port_;
    std::map<std::string, Operation, std::less<>> operations_;
};

} // namespace tandem::interceptor
