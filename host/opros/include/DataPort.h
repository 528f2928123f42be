// SPDX-License-Identifier: Apache-2.0
#ifndef DATAPORT_H_
#define DATAPORT_H_

#include <OPRoSTypes.h>
#include <Port.h>
#include <ReturnType.h>

/// Base class of input and output data ports. [any-thread] push, pop, peek and the checks of types.
class DataPort : public Port {
  public:
    DataPort();
    explicit DataPort(const std::string& name);
    virtual ~DataPort();

    /// Output: sends a copy to all connected inputs, in this thread. Input: puts a copy into the queue. Returns
    /// OPROS_BAD_INPUT_PARAMETER if the value is not of the port's type or cannot cross a link, and
    /// OPROS_OUT_OF_RESOURCES if a receiver across a link had no room. Blocks only for `wait_ms` of a link.
    virtual ReturnType push(opros_any& data) = 0;
    /// Pushes a value that is decoded from `size` bytes with the port's archive factory. Returns
    /// OPROS_UNSUPPORTED_METHOD if the port has no factory or its type cannot be archived.
    virtual ReturnType pushData(unsigned char* data, int size) = 0;
    /// Takes the next value from the queue, or NULL if it is empty. The caller deletes the value.
    virtual opros_any* pop() = 0;
    /// Returns a copy of the next value, which stays in the queue. The caller deletes the copy.
    virtual opros_any* peek() = 0;
    /// Returns true if the value is of the port's type: the same C++ type, or one with the same name on ports.
    virtual bool checkType(opros_any& data) = 0;
    /// Returns true if this port may be connected to `dst`. Called on both ports, and only when they are connected.
    virtual bool checkType(DataPort* dst) = 0;
    virtual DataPortRole getRole() = 0;
    /// Drops the values in the queue.
    virtual void reset() {}
};

#endif
