// SPDX-License-Identifier: Apache-2.0
#ifndef OUTPUTDATAPORTINTERFACE_H_
#define OUTPUTDATAPORTINTERFACE_H_

#include <ArchiveFactory.h>
#include <DataPort.h>
#include <IDataPortLink.h>

class OutputDataPortImpl;

/// An output data port of any type. Hands each value to its connections in the caller's thread; without a connection,
/// the value is dropped. Pushes of several threads are delivered one after the other. [any-thread] push
class OutputDataPortInterface : public DataPort {
  public:
    OutputDataPortInterface();
    explicit OutputDataPortInterface(const std::string& name);
    virtual ~OutputDataPortInterface();

    virtual ReturnType push(opros_any& data) = 0;
    virtual ReturnType pushData(unsigned char* data, int size) = 0;
    /// Encodes the value with the port's archive factory. Returns OPROS_UNSUPPORTED_METHOD if there is no factory or
    /// the type cannot be archived.
    virtual ReturnType marshal(opros_any& data, std::string& outdata) = 0;
    virtual bool checkType(opros_any& data) = 0;
    virtual bool checkType(DataPort* dst) = 0;
    /// Returns NULL, as peek() does: an output port stores nothing.
    virtual opros_any* pop();
    virtual opros_any* peek();
    virtual DataPortRole getRole();
    virtual void setArchiveFactory(ArchiveFactory* darc);
    /// For the host: adds a connection, which remains the caller's and must be removed before it is deleted. On
    /// return from removeConnection() no push uses it. Must not be called from within a push.
    virtual void addConnection(IDataPortLink* connection);
    virtual void removeConnection(IDataPortLink* connection);
    virtual void clearConnection();
    /// Ours, for the host: runs the code of a push without delivering a value. [one thread]
    void rehearse();

  protected:
    /// Implements push() of derived ports: checks the type and delivers to all connections. Returns the result of a
    /// connection that has refused or dropped the value; see DataPort::push().
    virtual ReturnType push_data(opros_any& data);
    /// Implements rehearse(): push_data() of a value, which then has no effect.
    virtual void rehearsePush() {}

    OutputDataPortImpl* m_impl;
    ArchiveFactory* m_arc;

  private:
    OutputDataPortInterface(const OutputDataPortInterface&);
    OutputDataPortInterface& operator=(const OutputDataPortInterface&);
};

#endif
