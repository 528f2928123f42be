// SPDX-License-Identifier: Apache-2.0
// Ours, for bridges.
#ifndef COMPONENTDIRECTORY_H_
#define COMPONENTDIRECTORY_H_

#include <Component.h>

#include <string>
#include <vector>

/// Transitions that a directory can request from a component.
enum ComponentTransition { TRANSITION_START, TRANSITION_STOP, TRANSITION_RECOVER, TRANSITION_DESTROY };

/// The components of an application, for a component that shares the others with another system. [any-thread] unless
/// stated otherwise.
class ComponentDirectory {
  public:
    virtual ~ComponentDirectory() {}
    /// Returns the names of the components that could be loaded, as the application profile lists them.
    virtual std::vector<std::string> names() const = 0;
    /// Returns the component, or NULL if no component has this name, for access to its ports, state and listeners. It
    /// exists until all components have been destroyed.
    virtual Component* find(const std::string& name) = 0;
    /// Returns the name in the component's profile, or an empty text if there is no such component.
    virtual std::string type(const std::string& name) const = 0;
    /// Makes a transition in the calling thread. Returns an empty text on success or if the component is already in
    /// that state, otherwise the reason in one line. A start or stop whose callback throws or fails puts the
    /// component in ERROR. Refused until all components of the application have started, and once the application
    /// ends.
    virtual std::string transition(const std::string& name, ComponentTransition transition) = 0;
    /// Sets a property in the component's thread, before its next cycle, or before its next start if it is not ACTIVE.
    /// Returns false if there is no such component.
    virtual bool setProperty(const std::string& component, const std::string& name,
                             const std::string& value) = 0;
    /// Returns whether the host was asked to end, possibly during set-up of the application.
    virtual bool isEnding() const = 0;
    /// Returns whether the application profile has a connection from that port.
    virtual bool isConnected(const std::string& component, const std::string& port) const = 0;
    /// Connects a port of the component `owner` with a port of `component`, like a connection of the application
    /// profile: an output event port with an input event port (the component's thread handles the events), or a
    /// provided with a required service port. Returns an empty text on success, otherwise the reason in one line.
    virtual std::string connect(const std::string& owner, Port& port, const std::string& component,
                                const std::string& component_port) = 0;
    /// Ends this connection. On return the port is not in use.
    virtual void disconnect(Port& port) = 0;
};

/// A component that also derives from this class gets the directory of its application before onInitialize(). Its
/// onInitialize() runs after that of all other components, when their ports exist. The directory outlives the
/// component.
class ComponentDirectoryUser {
  public:
    virtual ~ComponentDirectoryUser() {}
    virtual void setComponentDirectory(ComponentDirectory* directory) = 0;
};

#endif
