// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_INPORTCONNECTOR_H
#define RTC_INPORTCONNECTOR_H
#include <rtm/ConnectorListener.h>
#include <rtm/DirectBuffer.h>
#include <rtm/InPlaceBuffer.h>
#include <rtm/Timestamp.h>

namespace RTC {

/// The receiving end of a data connection, owned by its InPort, which reads it from one thread at a time.
/// Values go through the serializer of the connection's marshaling type (CDR unless it names another), except
/// for the two short cuts: a DirectBuffer has the value as it is, an InPlaceBuffer decodes it where it lies.
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

    /// Reads the oldest message into `stream`, in the byte order it came in.
    virtual DataPortStatus read(ByteDataStreamBase* stream);
    /// Reads the oldest message as bytes. BUFFER_EMPTY, BUFFER_TIMEOUT: the buffer has none, by its
    /// empty-policy.
    virtual DataPortStatus read(ByteData& bytes);
    /// Reads the oldest message as a value. PORT_ERROR: no serializer for its type; BUFFER_ERROR: it is not
    /// one.
    template <class DataType>
    DataPortStatus read(DataType& data) {
        auto* stream = m_serializer.get<DataType>(m_marshaling_type, m_profile.name, rtclog);
        if (stream == nullptr) return DataPortStatus::PORT_ERROR;
        DataPortStatus status = DataPortStatus::PORT_OK;
        m_readInPlace = false;
        if (m_directBuffer != nullptr && m_directBuffer->type() == typeid(DataType)) {
            status = readDirect(static_cast<DirectBuffer<DataType>&>(*m_directBuffer), *stream, data);
            if (status != DataPortStatus::PORT_OK) return status;
        } else if (m_inPlace != nullptr && m_serializer.isStandardCdr()) {
            CdrUnmarshal<DataType> reader(data);
            status = read(stream, reader, m_readInPlace);
            if (status != DataPortStatus::PORT_OK) return status;
            if (m_readInPlace ? !reader.valid : !stream->deserialize(data))
                return DataPortStatus::BUFFER_ERROR;
        } else {
            status = read(m_bytes);
            if (status != DataPortStatus::PORT_OK) return status;
            if (!m_serializer.isStandardCdr() || !detail::decode_timed_numbers(m_bytes, data)) {
                copyTo(stream);
                if (!stream->deserialize(data)) return DataPortStatus::BUFFER_ERROR;
            }
        }
        if (m_timestamp == TimestampPolicy::on_read) stampIfPossible(data, 0);
        return status;
    }

    /// Ours: was the last value decoded straight from the buffer, as each one can be?
    bool readsInPlace() const {
        return m_readInPlace && m_inPlace->minInPlaceLength() == 0 && m_timestamp != TimestampPolicy::on_read;
    }
    /// Ours: lets `reader` decode the oldest message in the buffer. Returns false, without side effects, if a listener wants the
    /// bytes. Call it only if readsInPlace().
    [[gnu::always_inline]] bool readInPlace(Unmarshal& reader, DataPortStatus& status) {
        // A warm-up may ask any connector.
        if (reader.isWarmUp() && (m_directBuffer || m_inPlace == nullptr || !m_serializer.isStandardCdr()))
            return false;
        if (m_listeners->has(ConnectorDataListenerType::ON_BUFFER_READ)) return false;
        bool read_in_place = true;
        const BufferStatus found = m_inPlace->readInPlace(m_bytes, reader, read_in_place);
        if (reader.isWarmUp()) return true;
        status = found == BufferStatus::OK ? DataPortStatus::PORT_OK // nobody listens
                                           : notifyNothingRead(found);
        return true;
    }
    /// Ours: whether there is a message for readInPlace(). Only if readsInPlace().
    bool isReadableInPlace() const { return m_buffer->readable() > 0; }

    /// Stores a message from the peer, after its ON_RECEIVED listeners: for an InPortProvider. [any-thread]
    virtual BufferStatus write(ByteData& bytes);
    /// Ours: how many messages can be read.
    std::size_t readableCount() {
        if (m_takesArrived) takeArrived();
        return m_directBuffer ? m_directBuffer->readable() : m_buffer->readable();
    }
    virtual void setEndian(bool little_endian) { m_littleEndian = little_endian; }
    virtual bool isLittleEndian() { return m_littleEndian; }

  protected:
    /// Ours: puts what has come by another way than write() into the buffer, before the port looks at it.
    virtual void takeArrived() {}
    DataPortStatus notifyReadResult(BufferStatus status, ByteData& bytes);
    DataPortStatus notifyNothingRead(BufferStatus status);
    template <class DataType>
    DataPortStatus readDirect(DirectBuffer<DataType>& buffer, ByteDataStream<DataType>& stream,
                              DataType& data) {
        const BufferStatus status = buffer.read(data);
        if (status != BufferStatus::OK || !m_listeners->has(ConnectorDataListenerType::ON_BUFFER_READ))
            return notifyReadResult(status, m_bytes);
        if (m_listeners->allTakeValues(typeid(DataType))) {
            m_listeners->notifyValue(ConnectorDataListenerType::ON_BUFFER_READ, m_profile, &data);
            return DataPortStatus::PORT_OK;
        }
        // A listener wants the bytes, and may change them: encoded for it and decoded again.
        stream.isLittleEndian(true);
        if (!stream.serialize(data)) return DataPortStatus::BUFFER_ERROR;
        m_bytes = stream;
        m_bytes.isLittleEndian(true);
        const DataPortStatus read_status = notifyReadResult(status, m_bytes);
        stream.isLittleEndian(true);
        stream.writeData(m_bytes.getBuffer(), m_bytes.getDataLength());
        return stream.deserialize(data) ? read_status : DataPortStatus::BUFFER_ERROR;
    }
    /// Ours: lets `reader` decode the oldest message in the buffer when it is long (`read_in_place` is true
    /// then), otherwise copies it into `stream`.
    DataPortStatus read(ByteDataStreamBase* stream, Unmarshal& reader, bool& read_in_place);
    void copyTo(ByteDataStreamBase* stream) const; // m_bytes

    Logger rtclog{"InPortConnector"};
    ConnectorInfo m_profile;
    ConnectorListenersBase* m_listeners;
    CdrBufferBase* m_buffer;
    bool m_littleEndian = true;
    std::string m_marshaling_type;
    TimestampPolicy m_timestamp;
    bool m_takesArrived = false; // whether takeArrived() does anything; set before the port has the connector

    InPlaceBuffer* m_inPlace = nullptr;               // m_buffer, when it is one
    std::shared_ptr<DirectBufferBase> m_directBuffer; // of a direct connection, else NULL

  private:
    bool m_readInPlace = false; // the last value
    ByteData m_bytes;
    ConnectorSerializer m_serializer;
};

} // namespace RTC
#endif
