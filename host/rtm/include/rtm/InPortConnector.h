// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_INPORTCONNECTOR_H
#define RTC_INPORTCONNECTOR_H
#include <rtm/ConnectorListener.h>
#include <rtm/DirectBuffer.h>
#include <rtm/InPlaceBuffer.h>
#include <rtm/Timestamp.h>
#include <typeinfo>

namespace RTC {

/// The receiving end of a data connection. Its port reads it from one thread at a time.
class InPortConnector : public ConnectorBase {
  public:
    InPortConnector(ConnectorInfo& info, ConnectorListenersBase* listeners, CdrBufferBase* buffer);
    ~InPortConnector() override;

    const ConnectorInfo& profile() override { return m_profile; }
    const char* id() override { return m_profile.id.c_str(); }
    const char* name() override { return m_profile.name.c_str(); }
    DataPortStatus disconnect() override = 0;
    CdrBufferBase* getBuffer() override { return m_buffer; }
    void activate() override {}
    void deactivate() override {}

    /// The oldest message into `stream`, in the byte order it came in.
    virtual DataPortStatus read(ByteDataStreamBase* stream);
    /// The oldest message as bytes.
    virtual DataPortStatus read(ByteData& bytes);
    template <class DataType>
    DataPortStatus read(DataType& data) {
        auto* stream = serializer<DataType>();
        if (stream == nullptr) return DataPortStatus::PORT_ERROR;
        DataPortStatus status = DataPortStatus::PORT_OK;
        if (m_directBuffer != nullptr && m_directBuffer->type() == typeid(DataType)) {
            status = readDirect(static_cast<DirectBuffer<DataType>&>(*m_directBuffer), *stream, data);
            if (status != DataPortStatus::PORT_OK) return status;
        } else if (m_inPlace != nullptr && m_isStandardCdr) {
            CdrUnmarshal<DataType> reader(data);
            bool read_in_place = false;
            status = read(stream, reader, read_in_place);
            if (status != DataPortStatus::PORT_OK) return status;
            if (read_in_place ? !reader.valid : !stream->deserialize(data))
                return DataPortStatus::BUFFER_ERROR;
        } else {
            status = read(static_cast<ByteDataStreamBase*>(stream));
            if (status != DataPortStatus::PORT_OK) return status;
            if (!stream->deserialize(data)) return DataPortStatus::BUFFER_ERROR;
        }
        if (m_timestamp == TimestampPolicy::on_read) stampIfPossible(data, 0);
        return status;
    }

    /// A message from the other end; ON_RECEIVED listeners first, then the buffer. [any-thread]
    virtual BufferStatus write(ByteData& bytes);
    /// Ours: how many messages wait.
    std::size_t readableCount() {
        return m_directBuffer ? m_directBuffer->readable() : getBuffer()->readable();
    }
    virtual void setEndian(bool little_endian) { m_littleEndian = little_endian; }
    virtual bool isLittleEndian() { return m_littleEndian; }

  protected:
    // Looked up once: the type of a connector never changes.
    template <class DataType>
    ByteDataStream<DataType>* serializer() {
        if (m_type == nullptr || (m_type != &typeid(DataType) && *m_type != typeid(DataType))) {
            SerializerFactory::instance().deleteObject(m_cdr);
            m_cdr = createSerializer<DataType>(m_marshaling_type);
            m_typedSerializer = dynamic_cast<ByteDataStream<DataType>*>(m_cdr);
            m_type = &typeid(DataType);
            m_isStandardCdr = m_cdr != nullptr && typeid(*m_cdr) == typeid(CORBA_CdrSerializer<DataType>);
            if (m_typedSerializer == nullptr)
                RTC_ERROR(("connector %s: no serializer for marshaling type %s", name(),
                           m_marshaling_type.c_str()));
        }
        return static_cast<ByteDataStream<DataType>*>(m_typedSerializer);
    }
    DataPortStatus notifyReadResult(BufferStatus status, ByteData& bytes);
    template <class DataType>
    DataPortStatus readDirect(DirectBuffer<DataType>& buffer, ByteDataStream<DataType>& stream,
                              DataType& data) {
        const BufferStatus status = buffer.read(data);
        if (status != BufferStatus::OK || !m_listeners->has(ConnectorDataListenerType::ON_BUFFER_READ))
            return notifyReadResult(status, m_bytes);
        // Listeners see bytes, and may change them.
        stream.isLittleEndian(true);
        if (!stream.serialize(data)) return DataPortStatus::BUFFER_ERROR;
        m_bytes = stream;
        m_bytes.isLittleEndian(true);
        const DataPortStatus read_status = notifyReadResult(status, m_bytes);
        stream.isLittleEndian(true);
        stream.writeData(m_bytes.getBuffer(), m_bytes.getDataLength());
        return stream.deserialize(data) ? read_status : DataPortStatus::BUFFER_ERROR;
    }
    /// Ours: the oldest message, if it is long, to `reader` where it lies, otherwise into `stream`.
    DataPortStatus read(ByteDataStreamBase* stream, Unmarshal& reader, bool& read_in_place);

    Logger rtclog{"InPortConnector"};
    ConnectorInfo m_profile;
    ConnectorListenersBase* m_listeners;
    CdrBufferBase* m_buffer;
    bool m_littleEndian = true;
    std::string m_marshaling_type;
    TimestampPolicy m_timestamp;
    ByteDataStreamBase* m_cdr = nullptr;

    InPlaceBuffer* m_inPlace = nullptr;               // the buffer, if it is one
    std::shared_ptr<DirectBufferBase> m_directBuffer; // of a direct connection

  private:
    bool m_isStandardCdr = false; // the serializer does what any stream does
    ByteData m_bytes;
    void* m_typedSerializer = nullptr;
    const std::type_info* m_type = nullptr;
};

} // namespace RTC
#endif
