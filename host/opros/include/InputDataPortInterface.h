// SPDX-License-Identifier: Apache-2.0
#ifndef INPUTDATAPORTINTERFACE_H_
#define INPUTDATAPORTINTERFACE_H_

#include <ArchiveFactory.h>
#include <DataPort.h>
#include <DataPortListener.h>
#include <DataPortSource.h>

#include <cstddef>

class InputDataPortImpl;

/// An input data port of any type, with its queue. A consumer polls: pop() returns at once. [any-thread] all functions,
/// except that setQueue(), addSource() and the setters must be called before the component runs.
class InputDataPortInterface : public DataPort {
  public:
    InputDataPortInterface();
    InputDataPortInterface(DataPortPolicy data_policy, unsigned int queue_limit);
    explicit InputDataPortInterface(const std::string& name);
    InputDataPortInterface(const std::string& name, DataPortPolicy data_policy, unsigned int queue_limit);
    virtual ~InputDataPortInterface();

    virtual DataPortRole getRole();
    virtual opros_any* peek();
    virtual opros_any* pop();
    /// Returns the number of values that pop() can take now.
    virtual int getSize();
    /// Sets the factory for pushData(), which must outlive the port. With NULL, pushData() is not supported.
    virtual void setArchiveFactory(ArchiveFactory* darc);
    /// Drops all values, including those that wait in sources. Called when the component stops.
    virtual void reset();

    /// Adds a source, which must exist until it is removed. pop(), peek() and getSize() treat its values as if they
    /// had been pushed: FIFO keeps as many of the newest as there is room for, LAST keeps one. Returns
    /// OPROS_UNSUPPORTED_METHOD if the port's type is not serializable (ours).
    virtual ReturnType addSource(DataPortSource* source);
    /// Removes the source. On return it is no longer in use (ours).
    virtual ReturnType removeSource(DataPortSource* source);
    /// Returns true if the port has a source that cannot notify the listener and must be polled (ours).
    bool hasPolledSources() const;
    /// Ours, for the host: returns the approximate getSize() and leaves a single value in a source that can count.
    /// Tells whether a cycle has left values. [consumer's thread]
    std::size_t countWaiting();
    /// Ours, for the host: runs the code of pop() without taking a value. Decodes the last value again if it came from a
    /// source. [consumer's thread]
    void rehearse();
    /// Ours, for the host: returns whether push() has no effect in a rehearsal, because it is not the component's own code.
    virtual bool canRehearsePush() const { return false; }
    /// Sets the listener of the port and its sources, or none if NULL. It must outlive all pushes and sources (ours).
    void setListener(DataPortListener* listener);
    /// Sets the queue that a profile asks for, before the port is in use. Returns OPROS_PRECONDITION_NOT_MET if the
    /// component's code has chosen a queue, which takes precedence (ours).
    ReturnType setQueue(DataPortPolicy policy, unsigned int limit);

    virtual ReturnType push(opros_any& data) = 0;
    virtual ReturnType pushData(unsigned char* data, int size) = 0;
    virtual ReturnType push(opros::archive::iarchive& in) = 0;
    virtual bool checkType(opros_any& data) = 0;
    virtual bool checkType(DataPort* dst) = 0;

  protected:
    /// Implements push() of derived ports: checks the type, stores a copy and notifies the listener.
    virtual ReturnType push_data(opros_any& data);

    InputDataPortImpl* m_impl;
    ArchiveFactory* m_arc;

  private:
    InputDataPortInterface(const InputDataPortInterface&);
    InputDataPortInterface& operator=(const InputDataPortInterface&);
};

#endif
