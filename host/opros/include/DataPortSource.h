// SPDX-License-Identifier: Apache-2.0
// Ours, for bridges.
#ifndef DATAPORTSOURCE_H_
#define DATAPORTSOURCE_H_

#include <DataPortListener.h>
#include <OPRoSAny.h>

#include <cstddef>
#include <string>

/// Values that wait outside the component, in shared memory for example, until the consumer asks the input port for
/// one: no thread has to move them. The port calls these functions under its lock, in the consumer's thread,
/// or in that of somebody who pushes a value that comes after them; they must not block, and must not use the port.
class DataPortSource {
  public:
    virtual ~DataPortSource() {}
    /// Takes the oldest value and decodes it into `value`, which holds one of the port's type; NULL: drops it. False: there
    /// is none. Throws what decoding throws; the value is dropped then.
    virtual bool take(opros_any* value) = 0;
    /// For a warm-up: decodes the value of the last take() once more. False: it is gone, or another thread is at work.
    virtual bool again(opros_any& /*value*/) { return false; }
    /// Asks for listener->arrived() whenever values come, in whichever thread of the source notices them; NULL ends
    /// that, and on return the last listener is not in use any more. False: this source does not notice, it has to be
    /// polled. Called under the port's lock; must not block.
    virtual bool setListener(DataPortListener* /*listener*/) { return false; }
    /// Called after take() has thrown; `why` is the exception's text.
    virtual void undecodable(const std::string& /*why*/) {}
    /// How many values wait, about: for whoever wants to know whether the consumer leaves some. -1: that shows only when
    /// they are taken.
    virtual long waiting() { return -1; }
    /// Of the values that wait, the port's queue has room for the `values` newest, 0: for all. take() is to give one of these,
    /// and the source counts the others as dropped; a source that cannot gives all. Called before the first take().
    virtual void setDepth(std::size_t /*values*/) {}
};

#endif
