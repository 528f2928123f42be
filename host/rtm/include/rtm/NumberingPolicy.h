// SPDX-License-Identifier: Apache-2.0
#ifndef RTM_NUMBERINGPOLICY_H
#define RTM_NUMBERINGPOLICY_H
#include <mutex>
#include <rtm/NumberingPolicyBase.h>
#include <string>
#include <vector>

namespace RTM {

/// Numbers instances 0, 1, 2 ... and reuses the numbers of deleted instances. [any-thread]
class ProcessUniquePolicy : public NumberingPolicyBase {
  public:
    std::string onCreate(void* object) override;
    void onDelete(void* object) override;

  private:
    std::mutex mutex_;
    std::vector<void*> objects_;
};

} // namespace RTM
#endif
