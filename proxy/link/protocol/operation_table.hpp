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

/// One operation of an interface, ready to call.
struct KnownOperation {
    std::string name;
    wire::Operation types;
    std::string problem; ///< why it cannot cross, one line; empty if it can
};

/// The parsed operations of a service interface. An operation that cannot cross is listed with its problem and does not
/// affect the others. Constant after construction. [any-thread]
class OperationTable {
  public:
    explicit OperationTable(const std::vector<ServiceOperation>& operations);

    /// Returns nullptr if there is no operation of this name.
    const KnownOperation* find(std::string_view name) const;
    /// Returns the operation for a method of this name: the operation with the same name, otherwise an attribute's
    /// operation. The operations `_get_x` and `_set_x` of an attribute correspond to the methods `get_x`, `getX`,
    /// `set_x`, `setX`.
    const KnownOperation* find_for_method(std::string_view method) const;
    bool empty() const { return operations_.empty(); }
    /// Returns true if both tables have the same operations with the same signatures.
    bool operator==(const OperationTable& other) const;
    auto begin() const { return operations_.begin(); }
    auto end() const { return operations_.end(); }

  private:
    std::map<std::string, KnownOperation, std::less<>> operations_;
};

} // namespace tandem::link
