// SPDX-License-Identifier: Apache-2.0
#ifndef COMPONENT_H_
#define COMPONENT_H_

#include <Event.h>
#include <LifecycleInterface.h>
#include <PortInterface.h>
#include <PropertyInterface.h>
#include <ReturnType.h>

#include <string>

/// What every OPRoS component derives from. A component adds its ports in its constructor or in onInitialize(), and
/// overrides the callbacks it needs; those it does not override return OPROS_UNSUPPORTED_METHOD.
///
/// Threads: the transitions (onInitialize, onStart, onStop, onDestroy) come one at a time. onExecute and onUpdated
/// come in the thread of the component's executor, onEvent and provided methods in others, at the same time: what
/// they share needs a lock of the component's own. An exception of a callback puts this component in ERROR; the
/// others continue.
class Component : public PropertyInterface, public LifecycleInterface, public PortInterface {
  public:
    Component();
    explicit Component(const std::string& compId);
    virtual ~Component();
    /// The component's name in its application, which the host sets before onInitialize().
    virtual void setId(std::string id);
    virtual std::string getId();

    /// An event has arrived at an input event port whose owner this component is. The event is deleted when the
    /// callback returns. In the component's own thread for events and non-blocking calls, in the order in which
    /// they were sent.
    virtual ReturnType onEvent(Event* evt);
    /// One cycle, in the executor's thread, while the component is ACTIVE. A return code that is not
    /// OPROS_SUCCESS is logged when it changes, and has no other consequence.
    virtual ReturnType onExecute();
    /// The second pass of the cycle, after onExecute() of all components of the same executor.
    virtual ReturnType onUpdated();
    /// Never called by this host: a period does not change while an application runs.
    virtual ReturnType onPeriodChanged();

  protected:
    // The callbacks of the life cycle (LifecycleInterface.h). A transition succeeds when its callback returns
    // OPROS_SUCCESS; with any other code it fails and the host takes the component out of the application.
    /// Once, before ports are connected: reads properties, adds ports, opens devices.
    virtual ReturnType onInitialize();
    /// Ports are connected, but the components that start later do not run yet.
    virtual ReturnType onStart();
    /// The executor has ended, unless it hangs in onExecute(): what a device must not go on doing ends here.
    virtual ReturnType onStop();
    virtual ReturnType onReset();
    /// The component is in ERROR now. In the thread in which the error has happened.
    virtual ReturnType onError();
    virtual ReturnType onRecover();
    /// At the end, unless it has never been initialized: closes devices. No other callback follows.
    virtual ReturnType onDestroy();
    /// After a successful stop: empties the queues of the input ports.
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
