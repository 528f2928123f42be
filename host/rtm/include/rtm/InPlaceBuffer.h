// SPDX-License-Identifier: Apache-2.0
// Ours, for bridges.
#ifndef RTC_INPLACEBUFFER_H
#define RTC_INPLACEBUFFER_H
#include <rtm/BufferStatus.h>
#include <rtm/ByteData.h>
#include <rtm/RTC.h>

namespace RTC {

/// Puts one value into a stream, as often as it is asked to: to count its bytes, to write them. False: it cannot.
class Marshal {
  public:
    virtual bool operator()(cdrStream& out) const = 0;

  protected:
    ~Marshal() = default;
};

/// Takes a message apart where it lies.
class Unmarshal {
  public:
    virtual void operator()(cdrStream& in) = 0;

  protected:
    ~Unmarshal() = default;
};

/// What a CdrBufferBase may be as well: a buffer in which long messages are made and read in place, without
/// ByteData and the copies to and from it. Its messages are little-endian.
class InPlaceBuffer {
  public:
    virtual ~InPlaceBuffer() = default;
    /// What a message is long from, in bytes.
    virtual std::size_t minInPlaceLength() const = 0;
    /// NOT_SUPPORTED: the message is not long, or it cannot be marshalled. Nothing has happened; write() it.
    virtual BufferStatus writeInPlace(const Marshal& marshal) = 0;
    /// Like read(), but a long message is shown to `reader`, and `read_in_place` set, instead of being copied to `bytes`.
    virtual BufferStatus readInPlace(ByteData& bytes, Unmarshal& reader, bool& read_in_place) = 0;
};

} // namespace RTC
#endif
