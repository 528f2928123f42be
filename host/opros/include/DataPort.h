// SPDX-License-Identifier: Apache-2.0
#ifndef DATAPORT_H_
#define DATAPORT_H_

#include <OPRoSTypes.h>
#include <Port.h>
#include <ReturnType.h>

/// What input and output data ports have in common. [any-thread] push, pop, peek and the checks of types.
class DataPort : public Port {
  public:
    DataPort();
    explicit DataPort(const std::string& name);
    virtual ~DataPort();

    /// Output: sends a copy to all connected inputs, in this thread. Input: puts a copy into the queue.
    /// OPROS_BAD_INPUT_PARAMETER: not the port's type. Never blocks on a receiver.
    virtual ReturnType push(opros_any& data) = 0;
    /// The same with `size` bytes of an encoded value, decoded with the port's archive factory.
    /// OPROS_UNSUPPORTED_METHOD: the port has no factory, or its type cannot be archived.
    virtual ReturnType pushData(unsigned char* data, int size) = 0;
    /// The next value of the queue, which the caller deletes; NULL when there is none.
    virtual opros_any* pop() = 0;
    /// A copy of the next value, which stays in the queue; the caller deletes the copy.
    virtual opros_any* peek() = 0;
    /// Whether the value is of the port's type: the same C++ type, or one of the same name on ports.
    virtual bool checkType(opros_any& data) = 0;
    /// Whether this port may be connected to that one. Both are asked at connection only.
    virtual bool checkType(DataPort* dst) = 0;
    virtual DataPortRole getRole() = 0;
    /// Drops the values in the queue.
    virtual void reset() {}
};

#endif
