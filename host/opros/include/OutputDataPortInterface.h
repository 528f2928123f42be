// SPDX-License-Identifier: Apache-2.0
#ifndef OUTPUTDATAPORTINTERFACE_H_
#define OUTPUTDATAPORTINTERFACE_H_

#include <ArchiveFactory.h>
#include <DataPort.h>
#include <IDataPortLink.h>

class OutputDataPortImpl;

/// An output data port: hands each value to its links in the caller's thread. Without a link the value is dropped.
class OutputDataPortInterface : public DataPort {
  public:
    OutputDataPortInterface();
    explicit OutputDataPortInterface(const std::string& name);
    virtual ~OutputDataPortInterface();

    virtual ReturnType push(opros_any& data) = 0;
    virtual ReturnType pushData(unsigned char* data, int size) = 0;
    virtual ReturnType marshal(opros_any& data, std::string& outdata) = 0;
    virtual bool checkType(opros_any& data) = 0;
    virtual bool checkType(DataPort* dst) = 0;
    virtual opros_any* pop();
    virtual opros_any* peek();
    virtual DataPortRole getRole();
    virtual void setArchiveFactory(ArchiveFactory* darc);
    virtual void addConnection(IDataPortLink* connection);
    virtual void removeConnection(IDataPortLink* connection);
    virtual void clearConnection();

  protected:
    virtual ReturnType push_data(opros_any& data);

    OutputDataPortImpl* m_impl;
    ArchiveFactory* m_arc;

  private:
    OutputDataPortInterface(const OutputDataPortInterface&);
    OutputDataPortInterface& operator=(const OutputDataPortInterface&);
};

#endif
