// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_INPORTCONNECTOR_H
#define RTC_INPORTCONNECTOR_H
#include <rtm/ConnectorListener.h>
#include <rtm/DirectBuffer.h>
#include <rtm/InPlaceBuffer.h>
#include <rtm/Timestamp.h>

namespace RTC {

/// The receiving end of a data connection. Its InPort owns it and reads it in one thread at a time. Values go through
/// the serializer of the connection's marshaling type (default CDR), with two exceptions: a DirectBuffer contains the
/// value itself, and an InPlaceBuffer decodes it in place.
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

    /// Reads the oldest message into `stream`, in its original byte order.
    virtual DataPortStatus read(ByteDataStreamBase* stream);
    /// Reads the oldest message as bytes. Returns BUFFER_EMPTY or BUFFER_TIMEOUT, depending on the empty-policy, if
    /// the buffer has none.
    virtual DataPortStatus read(ByteData& bytes);
    /// Reads the oldest message as a value. Returns PORT_ERROR if there is no serializer for its type, BUFFER_ERROR
    /// if the message is not such a value.
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

    /// Ours: returns true if the last value was decoded directly from the buffer, and every value can be.
    bool readsInPlace() const {
        return m_readInPlace && m_inPlace->minInPlaceLength() == 0 && m_timestamp != TimestampPolicy::on_read;
    }
    /// Ours: lets `reader` decode the oldest message in the buffer. Returns false, without side effects, if a
    /// listener wants the bytes. Call it only if readsInPlace().
    bool readInPlace(Unmarshal& reader, DataPortStatus& status) {
        if (m_listeners->has(ConnectorDataListenerType::ON_BUFFER_READ)) return false;
        bool read_in_place = true;
        const BufferStatus found = m_inPlace->readInPlace(m_bytes, reader, read_in_place);
        status = found == BufferStatus::OK ? DataPortStatus::PORT_OK // no listener
                                           : notifyNothingRead(found);
        return true;
    }
    /// Ours: returns true if there is a message for readInPlace(). Call it only if readsInPlace().
    bool isReadableInPlace() const { return m_buffer->readable() > 0; }

    /// Stores a message from the peer after its ON_RECEIVED listeners have run. For an InPortProvider. [any-thread]
    virtual BufferStatus write(ByteData& bytes);
    /// Ours: returns the number of messages that can be read.
    std::size_t readableCount() {
        if (m_takesArrived) takeArrived();
        return m_directBuffer ? m_directBuffer->readable() : m_buffer->readable();
    }
    virtual void setEndian(bool little_endian) { m_littleEndian = little_endian; }
    virtual bool isLittleEndian() { return m_littleEndian; }

  protected:
    /// Ours: moves messages that did not arrive through write() into the buffer, before the port checks it.
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
        // A listener wants the bytes and may change them, so the value is encoded for it and decoded again.
        stream.isLittleEndian(true);
        if (!stream.serialize(data)) return DataPortStatus::BUFFER_ERROR;
        m_bytes = stream;
        m_bytes.isLittleEndian(true);
        const DataPortStatus read_status = notifyReadResult(status, m_bytes);
        stream.isLittleEndian(true);
        stream.writeData(m_bytes.getBuffer(), m_bytes.getDataLength());
        return stream.deserialize(data) ? read_status : DataPortStatus::BUFFER_ERROR;
    }
    /// Ours: lets `reader` decode the oldest message in the buffer and sets `read_in_place` if the message is long.
    /// Otherwise copies the message into `stream`.
    DataPortStatus read(ByteDataStreamBase* stream, Unmarshal& reader, bool& read_in_place);
    void copyTo(ByteDataStreamBase* stream) const; // m_bytes

    Logger rtclog{"InPortConnector"};
    ConnectorInfo m_profile;
    ConnectorListenersBase* m_listeners;
    CdrBufferBase* m_buffer;
    bool m_littleEndian = true;
    std::string m_marshaling_type;
    TimestampPolicy m_timestamp;
    bool m_takesArrived = false; // takeArrived() does something; set before the port has the connector

    InPlaceBuffer* m_inPlace = nullptr;               // m_buffer, if it is one
    std::shared_ptr<DirectBufferBase> m_directBuffer; // of a direct connection, otherwise NULL

  private:
    bool m_readInPlace = false; // the last value
    ByteData m_bytes;
    ConnectorSerializer m_serializer;
};

} // namespace RTC
#endif
