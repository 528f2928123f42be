// SPDX-License-Identifier: Apache-2.0
// Ours, for bridges.
#ifndef DATAPORTSOURCE_H_
#define DATAPORTSOURCE_H_

#include <archive/opros_iarchive.h>

#include <string>

/// Values that wait outside the component until its input port is asked for one: the consumer polls the source
/// itself, no thread stands between. Called under the port's lock by whoever polls the port; must not block.
class DataPortSource {
  public:
    virtual ~DataPortSource() {}
    /// An archive placed on the oldest unread value, valid until done(); NULL when there is none.
    virtual opros::archive::iarchive* next() = 0;
    /// The value of the last next() has been read, or given up.
    virtual void done() = 0;
    /// Whether the value of the last next() was so long that the port should not copy what it decoded.
    virtual bool large() const { return false; }
    /// Comes before done() when the value could not be decoded and is dropped.
    virtual void undecodable(const std::string& /*why*/) {}
};

#endif
