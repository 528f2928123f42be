// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_DATAFLOWCOMPONENTBASE_H
#define RTC_DATAFLOWCOMPONENTBASE_H
#include <rtm/PeriodicExecutionContext.h>
#include <rtm/RTObject.h>

namespace RTC {

/// The base class of users' components.
class DataFlowComponentBase : public RTObject_impl {
  public:
    explicit DataFlowComponentBase(Manager* manager);
    ~DataFlowComponentBase() override;
    void init();
};

} // namespace RTC

// As in OpenRTM-aist: components use the manager without including its header. Last, because it needs the
// declarations above.
#include <rtm/Manager.h>
#endif
