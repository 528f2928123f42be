// SPDX-License-Identifier: Apache-2.0
#ifndef COMPONENT_H_
#define COMPONENT_H_

#include <Event.h>
#include <LifecycleInterface.h>
#include <PortInterface.h>
#include <PropertyInterface.h>
#include <ReturnType.h>

#include <string>

/// Base class of every OPRoS component. A component adds its ports in its constructor or in onInitialize(), and
/// overrides the callbacks that it needs. By default, a callback returns OPROS_UNSUPPORTED_METHOD.
///
/// Threads: transitions (onInitialize, onStart, onStop, onDestroy) run one at a time. onExecute and onUpdated run in
/// the thread of the component's executor. onEvent and provided methods run in other threads at the same time, so the
/// component must lock the data that they share. A callback that throws puts this component in ERROR; other
/// components continue.
class Component : public PropertyInterface, public LifecycleInterface, public PortInterface {
  public:
    Component();
    explicit Component(const std::string& compId);
    virtual ~Component();
    /// Sets the component's name in its application. The host calls it before onInitialize().
    virtual void setId(std::string id);
    virtual std::string getId();

    /// Handles an event that has arrived at an input event port owned by this component. The event is deleted when the
    /// callback returns. Runs in the component's thread for events and non-blocking calls, in the order of sending.
    virtual ReturnType onEvent(Event* evt);
    /// Runs one cycle in the executor's thread, while the component is ACTIVE. A return code other than OPROS_SUCCESS
    /// is logged when it changes and has no other effect.
    virtual ReturnType onExecute();
    /// Runs the second pass of the cycle, after onExecute() of all components of the same executor.
    virtual ReturnType onUpdated();
    /// Is never called by this host, because a period does not change while an application runs.
    virtual ReturnType onPeriodChanged();

  protected:
    // Callbacks of the life cycle (LifecycleInterface.h). A transition succeeds if its callback returns
    // OPROS_SUCCESS. With any other code it fails, and the host removes the component from the application.
    /// Is called once, before ports are connected: reads properties, adds ports, opens devices.
    virtual ReturnType onInitialize();
    /// Is called when ports are connected. Components that start later do not run yet.
    virtual ReturnType onStart();
    /// Is called when the executor has ended or hangs in onExecute(). Stops everything that devices must not
    /// continue.
    virtual ReturnType onStop();
    virtual ReturnType onReset();
    /// Is called when the component has gone to ERROR, in the thread in which the error happened.
    virtual ReturnType onError();
    virtual ReturnType onRecover();
    /// Is called last, unless the component was never initialized: closes devices.
    virtual ReturnType onDestroy();
    /// Empties the queues of the input ports after a successful stop.
    virtual void afterStop();

  private:
    std::string m_compId;
};

// Sources of OPRoS v1 export their factory only through this macro; without it, they cannot be loaded.
#if !defined(MAKE_COMPONENT_DLL) && !defined(MAKE_STATIC_COMPONENT)
#define MAKE_COMPONENT_DLL
#endif

/// The name of the class in OPRoS v1.
typedef Component IComponent;

#endif
