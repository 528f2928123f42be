// SPDX-License-Identifier: Apache-2.0
// Ours: the interface type `direct`, by which values of one process get from port to port as they are.
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
    virtual const std::type_info& type() const = 0;
    virtual void init(const coil::Properties& buffer) = 0;
    virtual std::size_t readable() const = 0;
    virtual bool full() const = 0;
    /// A message that had to be serialized after all: somebody listens to it, or it came from another process.
    virtual BufferStatus writeBytes(const ByteData& bytes) = 0;
};

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

/// Puts one value into a buffer. NOT_SUPPORTED: the buffer is for another type.
class DirectWriter {
  public:
    virtual BufferStatus operator()(DirectBufferBase& buffer) const = 0;

  protected:
    ~DirectWriter() = default;
};

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
