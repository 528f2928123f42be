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
    /// Stores a message that was serialized all the same: a listener wanted its bytes, or it came from
    /// another process. BUFFER_ERROR: it is not of the port's type.
    virtual BufferStatus writeBytes(const ByteData& bytes) = 0;
};

/// The same for one data type; reading gives copies of the values that were written.
template <class DataType>
class DirectBuffer : public DirectBufferBase {
  public:
    const std::type_info& type() const override { return typeid(DataType); }
    void init(const coil::Properties& buffer) override { m_values.init(buffer); }
    std::size_t readable() const override { return m_values.readable(); }
    bool full() const override { return m_values.full(); }
    BufferStatus write(const DataType& value) { return m_values.write(value); }
    BufferStatus read(DataType& value) { return m_values.read(value); }
    BufferStatus writeBytes(const ByteData& bytes) override {
        CORBA_CdrSerializer<DataType> stream;
        DataType value = DataType();
        stream.isLittleEndian(bytes.getEndian());
        stream.writeData(bytes.getBuffer(), bytes.getDataLength());
        return stream.deserialize(value) ? write(value) : BufferStatus::BUFFER_ERROR;
    }

  private:
    RingBuffer<DataType> m_values;
};

/// Writes one value, whose type the caller does not know, into a buffer. NOT_SUPPORTED: the buffer is for
/// another type.
class DirectWriter {
  public:
    virtual BufferStatus operator()(DirectBufferBase& buffer) const = 0;

  protected:
    ~DirectWriter() = default;
};

/// Refers to the value, which must outlive it.
template <class DataType>
class TypedDirectWriter final : public DirectWriter {
  public:
    explicit TypedDirectWriter(const DataType& value) : m_value(value) {}
    BufferStatus operator()(DirectBufferBase& buffer) const override {
        if (buffer.type() != typeid(DataType)) return BufferStatus::NOT_SUPPORTED;
        return static_cast<DirectBuffer<DataType>&>(buffer).write(m_value);
    }

  private:
    const DataType& m_value;
};

} // namespace RTC
#endif
