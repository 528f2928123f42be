// SPDX-License-Identifier: Apache-2.0
// The basic types of every OPRoS component.
#ifndef OPROSTYPES_H_
#define OPROSTYPES_H_

#include <AssertException.h>
#include <BoostNames.h>
#include <OPRoSAny.h>
#include <ReturnType.h>

#include <cassert>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

typedef enum { OPROS_MT_PROVIDED, OPROS_MT_REQUIRED, OPROS_MT_REMOTE } MethodType;
typedef enum { OPROS_SERVICE, OPROS_EVENT, OPROS_DATA, OPROS_REMOTE_DATA } PortType;
/// The order in which an input data port returns its values, and what it does if its queue is full. FIFO: oldest
/// first, drops the oldest; LAST: keeps only the newest; LIFO: newest first, grows; UFIFO: oldest first, grows.
typedef enum { OPROS_FIFO, OPROS_LIFO, OPROS_UFIFO, OPROS_LAST } DataPortPolicy;
typedef enum {
    OPROS_CS_CREATED,
    OPROS_CS_READY,
    OPROS_CS_ACTIVE,
    OPROS_CS_INACTIVE,
    OPROS_CS_ERROR,
    OPROS_CS_DESTROYED
} LifecycleState;
typedef enum { OPROS_DATA_PORT_INPUT, OPROS_DATA_PORT_OUTPUT } DataPortRole;
typedef enum { OPROS_EVENT_PORT_INPUT, OPROS_EVENT_PORT_OUTPUT } EventPortRole;
typedef enum { OPROS_SERVICE_PORT_REQUIRED, OPROS_SERVICE_PORT_PROVIDED } ServicePortRole;

#define DEFAULT_QUEUE_LIMIT 15

#ifndef opros_assert
#define opros_assert(func)                                                                                   \
    {                                                                                                        \
        if (!(func)) throw std::exception();                                                                 \
    }
#endif

/// An argument or the result of a service call while a connector passes it on.
class opros_params : public opros_any {
  public:
    opros_params() {}
    template <typename dataType>
    opros_params(const dataType& value) : opros_any(value) {}
    opros_params(const opros_params& other) : opros_any(static_cast<const opros_any&>(other)) {}

    using opros_any::operator=;
    template <typename dataType>
    opros_params& operator=(const dataType& value) {
        opros_any::operator=(value);
        return *this;
    }
    opros_params& operator=(const opros_params& other) {
        opros_any::operator=(static_cast<const opros_any&>(other));
        return *this;
    }
    /// Becomes a default-constructed value of the type, unless it already has a value.
    template <typename dataType>
    void setType(const dataType*) {
        if (empty()) opros_any::operator=(dataType());
    }
};

// The casts of OPRoSAny.h for opros_params: NULL or std::bad_cast for another type, no check in the last one.
template <typename dataType>
dataType* opros_params_cast(opros_params* operand) {
    return opros_any_cast<dataType>(static_cast<opros_any*>(operand));
}
template <typename dataType>
const dataType* opros_params_cast(const opros_params* operand) {
    return opros_any_cast<dataType>(static_cast<const opros_any*>(operand));
}
template <typename dataType>
dataType opros_params_cast(opros_params& operand) {
    return opros_any_cast<dataType>(static_cast<opros_any&>(operand));
}
template <typename dataType>
dataType* unsafe_opros_params_cast(opros_params* operand) {
    return unsafe_opros_any_cast<dataType>(static_cast<opros_any*>(operand));
}

#endif
