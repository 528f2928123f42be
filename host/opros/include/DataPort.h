// SPDX-License-Identifier: Apache-2.0
#ifndef DATAPORT_H_
#define DATAPORT_H_

#include <OPRoSTypes.h>
#include <Port.h>
#include <ReturnType.h>

/// What input and output data ports have in common.
class DataPort : public Port {
  public:
    DataPort();
    explicit DataPort(const std::string& name);
    virtual ~DataPort();

    /// Sends the value, or puts it into the port's queue. OPROS_BAD_INPUT_PARAMETER: not the port's type.
    virtual ReturnType push(opros_any& data) = 0;
    /// The same with an encoded value. OPROS_UNSUPPORTED_METHOD: the port cannot decode it.
    virtual ReturnType pushData(unsigned char* data, int size) = 0;
    /// The next value of the queue, which the caller deletes; NULL when there is none.
    virtual opros_any* pop() = 0;
    /// A copy of the next value, which stays in the queue.
    virtual opros_any* peek() = 0;
    virtual bool checkType(opros_any& data) = 0;
    virtual bool checkType(DataPort* dst) = 0;
    virtual DataPortRole getRole() = 0;
    virtual void reset() {}
};

#endif
