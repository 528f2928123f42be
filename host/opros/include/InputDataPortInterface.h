// SPDX-License-Identifier: Apache-2.0
#ifndef INPUTDATAPORTINTERFACE_H_
#define INPUTDATAPORTINTERFACE_H_

#include <ArchiveFactory.h>
#include <DataPort.h>
#include <DataPortListener.h>
#include <DataPortSource.h>

#include <cstddef>

class InputDataPortImpl;

/// An input data port and its queue, of whatever type. [any-thread] all functions, but setQueue(), addSource() and the
/// setters belong before the component runs. A consumer polls: pop() returns at once.
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
    /// The number of values that pop() could take now.
    virtual int getSize();
    /// For pushData(); must outlive the port. NULL: pushData() is not supported.
    virtual void setArchiveFactory(ArchiveFactory* darc);
    /// Drops all values, also those that wait in sources. Called when the component stops.
    virtual void reset();

    /// Every pop(), peek() and getSize() looks at the sources too, under the port's queue policy, as if their values had been
    /// pushed: with FIFO as many of the newest are kept as there is room for, with LAST one. The port's type must be
    /// serializable (OPROS_UNSUPPORTED_METHOD otherwise). The source must outlive its stay (ours).
    virtual ReturnType addSource(DataPortSource* source);
    /// On return the source is not in use and will not be used again (ours).
    virtual ReturnType removeSource(DataPortSource* source);
    /// Whether the port has a source that does not notify the listener of its values, and has to be polled (ours).
    bool hasPolledSources() const;
    /// Ours, for the host: as getSize(), but a value that waits alone stays in its source, if that can count. About: it tells
    /// whether a cycle has left some. [consumer's thread]
    std::size_t countWaiting();
    /// Ours, for the host: goes the way of a pop() without taking a value: decodes the last one once more, if it came from a
    /// source. [consumer's thread]
    void warmUp();
    /// The listener, which must outlive all pushes and sources, or NULL for none. Sources are asked to notify it, too
    /// (ours).
    void setListener(DataPortListener* listener);
    /// The queue that a profile asks for, before the port is in use. OPROS_PRECONDITION_NOT_MET: the component's own
    /// code has chosen one, which counts (ours).
    ReturnType setQueue(DataPortPolicy policy, unsigned int limit);

    virtual ReturnType push(opros_any& data) = 0;
    virtual ReturnType pushData(unsigned char* data, int size) = 0;
    virtual ReturnType push(opros::archive::iarchive& in) = 0;
    virtual bool checkType(opros_any& data) = 0;
    virtual bool checkType(DataPort* dst) = 0;

  protected:
    /// What push() of a derived port does: checks the type, stores a copy, notifies the listener.
    virtual ReturnType push_data(opros_any& data);

    InputDataPortImpl* m_impl;
    ArchiveFactory* m_arc;

  private:
    InputDataPortInterface(const InputDataPortInterface&);
    InputDataPortInterface& operator=(const InputDataPortInterface&);
};

#endif
