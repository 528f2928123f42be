// SPDX-License-Identifier: Apache-2.0
// Ours, for bridges.
#ifndef COMPONENTDIRECTORY_H_
#define COMPONENTDIRECTORY_H_

#include <Component.h>

#include <string>
#include <vector>

/// What a directory can ask a component to do.
enum ComponentTransition { TRANSITION_START, TRANSITION_STOP, TRANSITION_RECOVER, TRANSITION_DESTROY };

/// The components of an application, for one of them that shows the others elsewhere. [any-thread] where
/// nothing else is said.
class ComponentDirectory {
  public:
    virtual ~ComponentDirectory() {}
    /// Names of the components that could be loaded, as the application profile lists them.
    virtual std::vector<std::string> names() const = 0;
    /// NULL when there is none of this name. For its ports, state and listeners; it stays until all components have
    /// been destroyed.
    virtual Component* find(const std::string& name) = 0;
    /// The name in the component's profile; empty when there is none of this name.
    virtual std::string type(const std::string& name) const = 0;
    /// Makes a transition in the calling thread. Success when the component is in the wanted state already. A start
    /// or stop whose callback throws or fails puts it in ERROR. Returns why it was not made, one line; empty when it
    /// was. Refused until all components of the application have started, and once it ends.
    virtual std::string transition(const std::string& name, ComponentTransition transition) = 0;
    /// Sets a property before the component's next cycle, or before its next start when it is not ACTIVE, in the
    /// thread that runs it. False when there is none of this name.
    virtual bool setProperty(const std::string& component, const std::string& name,
                             const std::string& value) = 0;
    /// Whether the host was asked to end, perhaps while the application is being set up.
    virtual bool isEnding() const = 0;
    /// Whether the application profile has a connection from that port.
    virtual bool isConnected(const std::string& component, const std::string& port) const = 0;
    /// Connects a port of the component `owner` with one of `component`, as a connection of the application profile
    /// would: an output event port with its input event port, whose events the component's own thread handles, or a
    /// provided service port with its required one. Returns why it was not done, one line; empty when it was.
    virtual std::string connect(const std::string& owner, Port& port, const std::string& component,
                                const std::string& component_port) = 0;
    /// Ends that: on return the port is not in use.
    virtual void disconnect(Port& port) = 0;
};

/// A component that also derives from this gets the directory of its application before onInitialize(), which comes
/// after that of all other components, when their ports exist. The directory outlives the component.
class ComponentDirectoryUser {
  public:
    virtual ~ComponentDirectoryUser() {}
    virtual void setComponentDirectory(ComponentDirectory* directory) = 0;
};

#endif
