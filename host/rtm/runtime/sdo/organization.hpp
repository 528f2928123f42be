// SPDX-License-Identifier: Apache-2.0
// Groups of components as the SDO specification has them: an owner and its members.
#pragma once
#include <memory>
#include <mutex>
#include <rtm/SdoOrganization.h>
#include <string>
#include <vector>

namespace SDOPackage {

/// References to organizations, by their ids. [any-thread]
class Organizations {
  public:
    OrganizationList* list() const;
    /// False: nil, or there already.
    bool add(Organization_ptr organization);
    bool remove(const std::string& id);
    /// Takes the member `id` out of all of them.
    void leave(const std::string& id);

  private:
    mutable std::mutex mutex_;
    std::vector<Organization_var> all_;
};

} // namespace SDOPackage
