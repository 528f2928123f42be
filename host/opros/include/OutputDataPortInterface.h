// SPDX-License-Identifier: Apache-2.0
#ifndef OUTPUTDATAPORTINTERFACE_H_
#define OUTPUTDATAPORTINTERFACE_H_

#include <ArchiveFactory.h>
#include <DataPort.h>
#include <IDataPortLink.h>

class OutputDataPortImpl;

/// An output data port, of whatever type: hands each value to its connections in the caller's thread. Without a
/// connection the value is dropped. [any-thread] push; pushes of several threads are delivered one after the other.
class OutputDataPortInterface : public DataPort {
  public:
    OutputDataPortInterface();
    explicit OutputDataPortInterface(const std::string& name);
    virtual ~OutputDataPortInterface();

    virtual ReturnType push(opros_any& data) = 0;
    virtual ReturnType pushData(unsigned char* data, int size) = 0;
    /// Encodes the value with the port's archive factory. OPROS_UNSUPPORTED_METHOD: there is none, or the type
    /// cannot be archived.
    virtual ReturnType marshal(opros_any& data, std::string& outdata) = 0;
    virtual bool checkType(opros_any& data) = 0;
    virtual bool checkType(DataPort* dst) = 0;
    /// An output port stores nothing: both return NULL.
    virtual opros_any* pop();
    virtual opros_any* peek();
    virtual DataPortRole getRole();
    virtual void setArchiveFactory(ArchiveFactory* darc);
    /// For the host. The connection stays the caller's and must be removed before it is deleted; on return of
    /// removeConnection() no push is in it. Not from within a push.
    virtual void addConnection(IDataPortLink* connection);
    virtual void removeConnection(IDataPortLink* connection);
    virtual void clearConnection();
    /// Ours, for the host: goes the way of a push without delivering a value (DataPathWarmUp.h). [one thread]
    virtual void warmUp() {}

  protected:
    /// What push() of a derived port does: checks the type and goes through the connections.
    virtual ReturnType push_data(opros_any& data);

    OutputDataPortImpl* m_impl;
    ArchiveFactory* m_arc;

  private:
    OutputDataPortInterface(const OutputDataPortInterface&);
    OutputDataPortInterface& operator=(const OutputDataPortInterface&);
};

#endif
