// SPDX-License-Identifier: Apache-2.0
#ifndef RTM_NUMBERINGPOLICY_H
#define RTM_NUMBERINGPOLICY_H
#include <mutex>
#include <rtm/NumberingPolicyBase.h>
#include <string>
#include <vector>

namespace RTM {

/// Names instances 0, 1, 2 ...; a number that has become free is used again.
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
