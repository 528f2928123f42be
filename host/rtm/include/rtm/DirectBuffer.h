// SPDX-License-Identifier: Apache-2.0
// Ours: the buffer of the interface type `direct`, through which values go from port to port within one process
// without serialization.
#ifndef RTC_DIRECTBUFFER_H
#define RTC_DIRECTBUFFER_H
#include <memory>
#include <mutex>
#include <rtm/CORBA_CdrMemoryStream.h>
#include <rtm/RingBuffer.h>
#include <typeinfo>

namespace RTC {

/// The sender's value while it is passed to a DirectBuffer.
struct DirectValue {
    const std::type_info& type;
    const void* value;
};

/// The buffer of an InPort for its `direct` connections. [any-thread]
class DirectBufferBase {
  public:
    virtual ~DirectBufferBase() = default;
    /// Returns the port's data type. A writer of another type cannot use the buffer.
    virtual const std::type_info& type() const = 0;
    /// Takes a connection's properties below `buffer.`, like RingBuffer.
    virtual void init(const coil::Properties& buffer) = 0;
    virtual std::size_t readable() const = 0;
    /// Stores a copy of a value of type().
    virtual BufferStatus writeValue(const void* value) = 0;
    // The following set `overwritten` to whether a value was dropped to make room for this one.
    virtual BufferStatus writeValue(const void* value, bool& overwritten) = 0;
    /// Stores a value that copy() has created and that is no longer needed. Does not copy a long value again.
    virtual BufferStatus takeValue(void* value, bool& overwritten) = 0;
    /// Copies a value of type() to another, which it creates if it is NULL.
    virtual void copy(const void* from, std::shared_ptr<void>& to) const = 0;
    /// Stores a message that was serialized because a listener wanted its bytes or because it came from another
    /// process. Returns BUFFER_ERROR if it is not of the port's type.
    virtual BufferStatus writeBytes(const ByteData& bytes, bool& overwritten) = 0;
};

/// The buffer for one data type. Copies values when they are written. Does not copy long values again when they are
/// read: see RingBuffer::readOnce().
template <class DataType>
class DirectBuffer : public DirectBufferBase {
  public:
    DirectBuffer() { m_values.readOnce(); }
    const std::type_info& type() const override { return typeid(DataType); }
    void init(const coil::Properties& buffer) override { m_values.init(buffer); }
    std::size_t readable() const override { return m_values.readable(); }
    BufferStatus read(DataType& value) { return m_values.read(value); }
    BufferStatus writeValue(const void* value) override {
        return m_values.write(*static_cast<const DataType*>(value));
    }
    BufferStatus writeValue(const void* value, bool& overwritten) override {
        return m_values.writeReporting(*static_cast<const DataType*>(value), overwritten);
    }
    BufferStatus takeValue(void* value, bool& overwritten) override {
        return m_values.writeTaking(*static_cast<DataType*>(value), overwritten);
    }
    void copy(const void* from, std::shared_ptr<void>& to) const override {
        if (to == nullptr) to.reset(static_cast<void*>(new DataType()), destroy);
        copyValue(*static_cast<DataType*>(to.get()), *static_cast<const DataType*>(from));
    }
    BufferStatus writeBytes(const ByteData& bytes, bool& overwritten) override {
        CORBA_CdrSerializer<DataType> stream;
        DataType value = DataType();
        stream.isLittleEndian(bytes.getEndian());
        stream.writeData(bytes.getBuffer(), bytes.getDataLength());
        return stream.deserialize(value) ? m_values.writeReporting(value, overwritten)
                                         : BufferStatus::BUFFER_ERROR;
    }

  private:
    static void destroy(void* value) { delete static_cast<DataType*>(value); }

    RingBuffer<DataType> m_values;
};

} // namespace RTC
#endif
