// SPDX-License-Identifier: Apache-2.0
#ifndef COMPONENT_H_
#define COMPONENT_H_

#include <Event.h>
#include <LifecycleInterface.h>
#include <PortInterface.h>
#include <PropertyInterface.h>
#include <ReturnType.h>

#include <string>

/// What every OPRoS component derives from. The callbacks it does not override return OPROS_UNSUPPORTED_METHOD.
class Component : public PropertyInterface, public LifecycleInterface, public PortInterface {
  public:
    Component();
    explicit Component(const std::string& compId);
    virtual ~Component();
    virtual void setId(std::string id);
    virtual std::string getId();

    /// An event has arrived at a port that this component owns. The event lives until the callback returns.
    /// Called in a worker thread of the host, beside the executor's thread.
    virtual ReturnType onEvent(Event* evt);
    /// One cycle, in the executor's thread, while the component is ACTIVE.
    virtual ReturnType onExecute();
    /// The second pass of the cycle, after all components of the executor have had the first.
    virtual ReturnType onUpdated();
    virtual ReturnType onPeriodChanged();

  protected:
    virtual ReturnType onInitialize();
    virtual ReturnType onStart();
    virtual ReturnType onStop();
    virtual ReturnType onReset();
    virtual ReturnType onError();
    virtual ReturnType onRecover();
    virtual ReturnType onDestroy();
    virtual void afterStop();

  private:
    std::string m_compId;
};

// Sources of OPRoS v1 export their factory only with this, and have no other way to be loaded.
#if !defined(MAKE_COMPONENT_DLL) && !defined(MAKE_STATIC_COMPONENT)
#define MAKE_COMPONENT_DLL
#endif

/// The name by which components of OPRoS v1 know the class.
typedef Component IComponent;

#endif
