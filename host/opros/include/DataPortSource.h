// SPDX-License-Identifier: Apache-2.0
// Ours, for bridges.
#ifndef DATAPORTSOURCE_H_
#define DATAPORTSOURCE_H_

#include <DataPortListener.h>
#include <OPRoSAny.h>

#include <cstddef>
#include <string>

/// Values that wait outside the component, for example in shared memory, until the consumer asks the input port for
/// one. No thread has to move them. The port calls these functions under its lock, in the consumer's thread or in a
/// thread that pushes a later value. They must not block and must not use the port.
class DataPortSource {
  public:
    virtual ~DataPortSource() {}
    /// Takes the oldest value and decodes it into `value`, which holds a value of the port's type, or drops it if
    /// `value` is NULL. Returns false if no value waits. If decoding throws, the value is dropped and the exception
    /// passes through.
    virtual bool take(opros_any* value) = 0;
    /// For InputDataPortInterface::rehearse(): decodes the value of the last take() again. Returns false if the value is
    /// gone or another thread is using the source.
    virtual bool again(opros_any& /*value*/) { return false; }
    /// Sets the listener whose arrived() a thread of the source calls when values arrive. NULL removes it; on return
    /// the last listener is no longer in use. Returns false if this source cannot notify and must be polled. Called
    /// under the port's lock; must not block.
    virtual bool setListener(DataPortListener* /*listener*/) { return false; }
    /// Is called after take() has thrown; `why` is the text of the exception.
    virtual void undecodable(const std::string& /*why*/) {}
    /// Returns the approximate number of waiting values, or -1 if only take() can tell. The host uses it to find out
    /// whether the consumer leaves values.
    virtual long waiting() { return -1; }
    /// Says that the port's queue has room for the `values` newest of the waiting values (0: for all). take() then
    /// returns only these, and the source counts the others as dropped. A source that cannot do this returns all
    /// values. Called before the first take().
    virtual void setDepth(std::size_t /*values*/) {}
    /// Returns true if the sender waits for room. The port then leaves values for which its queue has no room here.
    virtual bool waitsForRoom() { return false; }
    /// Is called when the port's queue drops a value of this source that was not popped.
    virtual void discarded() {}
};

#endif
