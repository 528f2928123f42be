// SPDX-License-Identifier: Apache-2.0
#ifndef RTM_NUMBERINGPOLICYBASE_H
#define RTM_NUMBERINGPOLICYBASE_H
#include <string>

namespace RTM {

/// Creates the part of an instance name that follows the type name.
class NumberingPolicyBase {
  public:
    virtual ~NumberingPolicyBase() = default;
    virtual std::string onCreate(void* object) = 0;
    virtual void onDelete(void* object) = 0;
};

} // namespace RTM
#endif
