// SPDX-License-Identifier: Apache-2.0
// Ours: the buffer behind the interface type `direct`, by which values go from port to port within one
// process without being serialized.
#ifndef RTC_DIRECTBUFFER_H
#define RTC_DIRECTBUFFER_H
#include <memory>
#include <mutex>
#include <rtm/CORBA_CdrMemoryStream.h>
#include <rtm/RingBuffer.h>
#include <typeinfo>

namespace RTC {

/// A value on its way to a DirectBuffer: the sender's own.
struct DirectValue {
    const std::type_info& type;
    const void* value;
};

/// The buffer of an InPort for its `direct` connections. [any-thread]
class DirectBufferBase {
  public:
    virtual ~DirectBufferBase() = default;
    /// The data type of the port; a writer of another type cannot use the buffer.
    virtual const std::type_info& type() const = 0;
    /// With a connection's properties below `buffer.`, as RingBuffer.
    virtual void init(const coil::Properties& buffer) = 0;
    virtual std::size_t readable() const = 0;
    virtual bool full() const = 0;
    /// Stores a copy of a value of type().
    virtual BufferStatus writeValue(const void* value) = 0;
    /// Stores a value that copy() has made and that is not needed any more: a long one is not copied again.
    virtual BufferStatus takeValue(void* value) = 0;
    /// Copies a value of type() to another, which is made if it is NULL.
    virtual void copy(const void* from, std::shared_ptr<void>& to) const = 0;
    /// Stores a message that was serialized all the same: a listener wanted its bytes, or it came from
    /// another process. BUFFER_ERROR: it is not of the port's type.
    virtual BufferStatus writeBytes(const ByteData& bytes) = 0;
};

/// The same for one data type. Values are copied when they are written, and long ones not once more when they are read: see
/// RingBuffer::readOnce().
template <class DataType>
class DirectBuffer : public DirectBufferBase {
  public:
    DirectBuffer() { m_values.readOnce(); }
    [[gnu::hot]] const std::type_info& type() const override { return typeid(DataType); }
    void init(const coil::Properties& buffer) override { m_values.init(buffer); }
    [[gnu::hot]] std::size_t readable() const override { return m_values.readable(); }
    bool full() const override { return m_values.full(); }
    [[gnu::hot]] BufferStatus read(DataType& value) { return m_values.read(value); }
    [[gnu::hot]] BufferStatus writeValue(const void* value) override {
        return m_values.write(*static_cast<const DataType*>(value));
    }
    BufferStatus takeValue(void* value) override {
        return m_values.writeTaking(*static_cast<DataType*>(value));
    }
    void copy(const void* from, std::shared_ptr<void>& to) const override {
        if (to == nullptr) to.reset(static_cast<void*>(new DataType()), destroy);
        copyValue(*static_cast<DataType*>(to.get()), *static_cast<const DataType*>(from));
    }
    BufferStatus writeBytes(const ByteData& bytes) override {
        CORBA_CdrSerializer<DataType> stream;
        DataType value = DataType();
        stream.isLittleEndian(bytes.getEndian());
        stream.writeData(bytes.getBuffer(), bytes.getDataLength());
        return stream.deserialize(value) ? m_values.write(value) : BufferStatus::BUFFER_ERROR;
    }

  private:
    static void destroy(void* value) { delete static_cast<DataType*>(value); }

    RingBuffer<DataType> m_values;
};

} // namespace RTC
#endif
