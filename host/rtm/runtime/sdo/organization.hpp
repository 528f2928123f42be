// SPDX-License-Identifier: Apache-2.0
// Groups of components: the interface Organization of the OMG SDO specification, an owner and its members.
#pragma once
#include <memory>
#include <mutex>
#include <rtm/SdoOrganization.h>
#include <string>
#include <vector>

namespace SDOPackage {

/// A set of references to organizations, local or remote: those that a component owns, or is a member of.
/// [any-thread]
class Organizations {
  public:
    OrganizationList* list() const;
    /// Returns false if the reference is nil or already in the set.
    bool add(Organization_ptr organization);
    /// Removes the organization with this id, and calls the organizations for their ids. Returns false if none matches.
    bool remove(const std::string& id);
    /// Removes the member `id` from all organizations and empties the set. Unreachable ones are skipped.
    void leave_all(const std::string& id);

  private:
    mutable std::mutex mutex_;
    std::vector<Organization_var> all_;
};

} // namespace SDOPackage
