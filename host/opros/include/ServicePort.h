// SPDX-License-Identifier: Apache-2.0
#ifndef SERVICEPORT_H_
#define SERVICEPORT_H_

#include <ArchiveFactory.h>
#include <Port.h>
#include <ReturnType.h>

/// Base class of provided and required service ports.
class ServicePort : public Port {
  public:
    ServicePort();
    explicit ServicePort(const std::string& name);
    virtual ~ServicePort();
    virtual ServicePortRole getRole() = 0;
    virtual void reset() {}
    /// Returns true if the port learns its methods at connection, through bindMethod() or bindProvided(), instead of
    /// having them from the beginning (ours, for bridges).
    virtual bool isDynamic() const { return false; }
};

#endif
