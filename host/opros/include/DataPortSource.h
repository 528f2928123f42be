// SPDX-License-Identifier: Apache-2.0
// Ours, for bridges.
#ifndef DATAPORTSOURCE_H_
#define DATAPORTSOURCE_H_

#include <DataPortListener.h>
#include <archive/opros_iarchive.h>

#include <string>

/// Values that wait outside the component, in shared memory for example, until the consumer asks the input port for
/// one: no thread has to move them. The port calls these functions under its lock, in the consumer's thread; they
/// must not block, and must not use the port.
class DataPortSource {
  public:
    virtual ~DataPortSource() {}
    /// An archive that reads the oldest value not yet taken, valid until done(); NULL when there is none.
    virtual opros::archive::iarchive* next() = 0;
    /// The value of the last next() has been read or dropped. Each next() that gave an archive is followed by one.
    virtual void done() = 0;
    /// For a warm-up: the value of the last next() once more; NULL when it is gone, or another thread is at work. done()
    /// follows, as with next().
    virtual opros::archive::iarchive* again() { return 0; }
    /// Asks for listener->arrived() whenever values come, in whichever thread of the source notices them; NULL ends
    /// that, and on return the last listener is not in use any more. False: this source does not notice, it has to be
    /// polled. Called under the port's lock; must not block.
    virtual bool setListener(DataPortListener* /*listener*/) { return false; }
    /// Called before done() when the value could not be decoded and is dropped; `why` is the exception's text.
    virtual void undecodable(const std::string& /*why*/) {}
};

#endif
