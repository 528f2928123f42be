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

/// The parts of a value in RTM's usual form: `Time tm` and one sequence of numbers whose bytes are their CDR. `tm` is
/// NULL for other values. Such a message can be copied without a stream. Void: void or const void.
template <class Void>
struct TimedNumbers {
    Void* tm;       ///< seconds and nanoseconds as in CDR
    Void* elements; ///< the elements of the sequence
    std::uint32_t count, element_bytes;
};

/// Encodes one value into a stream. May be called several times, first to count the bytes, then to write them.
/// Returns false if the value cannot be encoded.
class Marshal {
  public:
    virtual bool operator()(cdrStream& out) const = 0;
    const TimedNumbers<const void>& numbers() const { return m_numbers; }

  protected:
    explicit Marshal(const TimedNumbers<const void>& numbers) : m_numbers(numbers) {}
    ~Marshal() = default;

  private:
    TimedNumbers<const void> m_numbers;
};

/// Decodes a message from a stream over the buffer's memory.
class Unmarshal {
  public:
    virtual void operator()(cdrStream& in) = 0;
    /// Returns the current value. Instead of decoding, a message with the same number of elements may be copied over it.
    const TimedNumbers<void>& numbers() const { return m_numbers; }

  protected:
    explicit Unmarshal(const TimedNumbers<void>& numbers) : m_numbers(numbers) {}
    ~Unmarshal() = default;

  private:
    TimedNumbers<void> m_numbers;
};

/// A CdrBufferBase may also implement this class. Long messages are then encoded into, and decoded from, the buffer's
/// own memory, which saves the copies to and from ByteData. The messages are little-endian. The thread rules of
/// BufferBase apply.
class InPlaceBuffer {
  public:
    virtual ~InPlaceBuffer() = default;
    /// Returns the length in bytes from which a message counts as long.
    virtual std::size_t minInPlaceLength() const = 0;
    /// Returns NOT_SUPPORTED, without side effects, if the message is not long or cannot be encoded. Then use
    /// write().
    virtual BufferStatus writeInPlace(const Marshal& marshal) = 0;
    /// Reads like read(), but passes a long message to `reader` instead of copying it to `bytes`, and sets
    /// `read_in_place`.
    virtual BufferStatus readInPlace(ByteData& bytes, Unmarshal& reader, bool& read_in_place) = 0;
};

} // namespace RTC
#endif
