// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"
#include "proxy/wire/operation.hpp"

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tandem::link {

/// One operation of an interface, ready to be called.
struct KnownOperation {
    std::string name;
    wire::Operation types;
    std::string problem; ///< why it cannot cross, one line; empty if it can
};

/// The operations of a service interface, parsed. An operation that cannot cross is there with its problem, so that
/// it costs none of the others. Constant after construction. [any-thread]
class OperationTable {
  public:
    explicit OperationTable(const std::vector<ServiceOperation>& operations);

    /// nullptr if there is none of that name.
    const KnownOperation* find(std::string_view name) const;
    /// The operation that a method of that name stands for: the one of the same name, otherwise an attribute's, whose
    /// operations `_get_x` and `_set_x` are also the methods `get_x`, `getX`, `set_x`, `setX`.
    const KnownOperation* find_for_method(std::string_view method) const;
    bool empty() const { return operations_.empty(); }
    /// Whether the other one has the same operations with the same signatures.
    bool operator==(const OperationTable& other) const;
    auto begin() const { return operations_.begin(); }
    auto end() const { return operations_.end(); }

  private:
    std::map<std::string, KnownOperation, std::less<>> operations_;
};

} // namespace tandem::link
