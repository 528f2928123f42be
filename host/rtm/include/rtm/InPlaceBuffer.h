// SPDX-License-Identifier: Apache-2.0
// Ours, for bridges whose shared memory can hold a message while it is encoded or decoded.
#ifndef RTC_INPLACEBUFFER_H
#define RTC_INPLACEBUFFER_H
#include <cstddef>
#include <cstdint>
#include <rtm/BufferStatus.h>
#include <rtm/ByteData.h>
#include <rtm/RTC.h>

namespace RTC {

/// What a value of RTM's usual form consists of: `Time tm` and one sequence of numbers whose bytes are their CDR. `tm` is
/// NULL for other values. So such a message can be copied without a stream. Void: void, or const void.
template <class Void>
struct TimedNumbers {
    Void* tm;       ///< its seconds and nanoseconds, as CDR has them
    Void* elements; ///< of the sequence
    std::uint32_t count, element_bytes;
};

/// Encodes one value into a stream. May be called several times, first to count the bytes, then to write them. Returns
/// false if the value cannot be encoded.
class Marshal {
  public:
    virtual bool operator()(cdrStream& out) const = 0;
    const TimedNumbers<const void>& numbers() const { return m_numbers; }
    /// A warm-up goes the way of a message and sends none, so that the code and the data of that way are in the caches when
    /// the component writes.
    bool isWarmUp() const { return m_warmUp; }

  protected:
    Marshal(const TimedNumbers<const void>& numbers, bool warm_up) : m_numbers(numbers), m_warmUp(warm_up) {}
    ~Marshal() = default;

  private:
    TimedNumbers<const void> m_numbers;
    bool m_warmUp;
};

/// Decodes a message from a stream over the buffer's memory.
class Unmarshal {
  public:
    virtual void operator()(cdrStream& in) = 0;
    /// The value as it is: a message of as many numbers may be copied over it instead.
    const TimedNumbers<void>& numbers() const { return m_numbers; }
    /// A warm-up reads the last message once more and takes none, so that the code and the data of that way are in the caches
    /// when a message comes.
    bool isWarmUp() const { return m_warmUp; }

  protected:
    Unmarshal(const TimedNumbers<void>& numbers, bool warm_up) : m_numbers(numbers), m_warmUp(warm_up) {}
    ~Unmarshal() = default;

  private:
    TimedNumbers<void> m_numbers;
    bool m_warmUp;
};

/// A CdrBufferBase may implement this as well: long messages are then encoded into, and decoded from, the
/// buffer's own memory, which saves the copies to and from ByteData. Its messages are little-endian. The
/// thread rules are those of BufferBase.
class InPlaceBuffer {
  public:
    virtual ~InPlaceBuffer() = default;
    /// From how many bytes on a message counts as long.
    virtual std::size_t minInPlaceLength() const = 0;
    /// NOT_SUPPORTED: the message is not long, or cannot be encoded. Nothing has happened then: use write().
    virtual BufferStatus writeInPlace(const Marshal& marshal) = 0;
    /// Like read(), but a long message is shown to `reader`, and `read_in_place` set, instead of being copied
    /// to `bytes`.
    virtual BufferStatus readInPlace(ByteData& bytes, Unmarshal& reader, bool& read_in_place) = 0;
};

} // namespace RTC
#endif
