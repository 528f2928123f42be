// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_DATAFLOWCOMPONENTBASE_H
#define RTC_DATAFLOWCOMPONENTBASE_H
#include <rtm/PeriodicExecutionContext.h>
#include <rtm/RTObject.h>

namespace RTC {

/// What components derive from.
class DataFlowComponentBase : public RTObject_impl {
public:
    explicit DataFlowComponentBase(Manager* manager);
    ~DataFlowComponentBase() override;
    void init();
};

} // namespace RTC
#endif
