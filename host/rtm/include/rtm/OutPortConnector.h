// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_OUTPORTCONNECTOR_H
#define RTC_OUTPORTCONNECTOR_H
#include <rtm/ConnectorListener.h>
#include <rtm/DirectBuffer.h>
#include <rtm/InPlaceBuffer.h>
#include <rtm/Timestamp.h>

namespace RTC {

/// The sending end of a data connection. Its OutPort owns it and writes it in one thread at a time. Values go through
/// the serializer of the connection's marshaling type (default CDR), with two exceptions: unserialized into a
/// DirectBuffer, or encoded directly into an InPlaceBuffer.
class OutPortConnector : public ConnectorBase {
  public:
    OutPortConnector(ConnectorInfo& info, ConnectorListenersBase* listeners);
    ~OutPortConnector() override;

    const ConnectorInfo& profile() override { return m_profile; }
    const char* id() override { return m_profile.id.c_str(); }
    const char* name() override { return m_profile.name.c_str(); }
    DataPortStatus disconnect() override = 0;
    CdrBufferBase* getBuffer() override { return nullptr; }
    void activate() override {}
    void deactivate() override {}

    /// Sends the content of `stream`, which must be in the connector's byte order.
    virtual DataPortStatus write(ByteDataStreamBase* stream);
    /// Sends serialized bytes, which contain their byte order.
    virtual DataPortStatus write(ByteData& bytes) = 0;
    /// Sends a value. Returns PORT_ERROR if it cannot be serialized, otherwise the result of the receiver or the
    /// buffer. `in_place`: may encode it directly into the receiver's buffer; otherwise other connectors can share the
    /// bytes.
    template <class DataType>
    DataPortStatus write(DataType& data, bool in_place = true) {
        auto* stream = m_serializer.get<DataType>(m_marshaling_type, m_profile.name, rtclog);
        if (stream == nullptr) return DataPortStatus::PORT_ERROR;
        const bool stamps =
            m_timestamp == TimestampPolicy::on_write || m_timestamp == TimestampPolicy::on_send;
        m_sentInPlace = false;
        if (m_direct && !stamps) {
            DataPortStatus status = DataPortStatus::PORT_OK;
            m_sentInPlace = writeDirect({typeid(DataType), &data}, status);
            if (m_sentInPlace) return status;
        }
        // The length of this message is unknown before it is encoded. The last message's length serves as a guess.
        if (in_place && m_bytes.getDataLength() >= m_minInPlaceLength && m_serializer.isStandardCdr() &&
            m_littleEndian && !stamps) {
            DataPortStatus status = DataPortStatus::PORT_OK;
            m_sentInPlace = writeInPlace(CdrMarshal<DataType>(data), status);
            if (m_sentInPlace) return status;
        }
        stream->isLittleEndian(isLittleEndian());
        bool serialized = false;
        if (stamps) {
            DataType stamped(data); // does not change the component's variable
            stampIfPossible(stamped, 0);
            serialized = stream->serialize(stamped);
        } else {
            serialized = stream->serialize(data);
        }
        return serialized ? write(static_cast<ByteDataStreamBase*>(stream)) : DataPortStatus::PORT_ERROR;
    }

    /// Takes the oldest message that waits for the peer. For a library's OutPortProvider, which calls the listeners
    /// itself. Returns PRECONDITION_NOT_MET if this connector stores no messages.
    virtual BufferStatus read(ByteData& bytes);

    virtual void setEndian(bool little_endian) { m_littleEndian = little_endian; }
    virtual bool isLittleEndian() { return m_littleEndian; }
    /// Ours: returns true if this connector would send exactly the bytes that `other` has sent last: byte order and
    /// marshaling type are the same, neither sets the time, there were bytes, and this connector needs them.
    bool canShareBytesOf(const OutPortConnector& other) const;
    /// Ours: returns false if the last value was passed on unserialized, or encoded in the receiver's buffer.
    bool hasSerialized() const { return !m_sentInPlace; }
    /// Ours: returns true if the last value was encoded directly into the receiver's buffer, and every value can be.
    bool writesInPlace() const {
        return m_sentInPlace && !m_direct && m_minInPlaceLength == 0 && m_littleEndian;
    }
    /// Ours: the bytes of the last write of a value. Valid if canShareBytesOf() has returned true.
    ByteData& serializedBytes() { return m_bytes; }

  protected:
    /// Ours: encodes a message directly into the receiver's buffer. Returns false, without side effects, if the
    /// message is short or the receiver has no InPlaceBuffer.
    virtual bool writeInPlace(const Marshal& marshal, DataPortStatus& status);

    /// Ours: passes a value to an InPort of this process without serializing it. Returns false, without side effects,
    /// if it cannot.
    virtual bool writeDirect(const DirectValue& message, DataPortStatus& status);

    Logger rtclog{"OutPortConnector"};
    ConnectorInfo m_profile;
    bool m_littleEndian = true;
    ConnectorListenersBase* m_listeners;
    std::string m_marshaling_type;
    TimestampPolicy m_timestamp;

    unsigned long m_minInPlaceLength = static_cast<unsigned long>(-1); // of the InPlaceBuffer, if any
    bool m_direct = false;                                             // the receiver has a DirectBuffer

  private:
    bool m_sentInPlace = false;
    ByteData m_bytes;
    ConnectorSerializer m_serializer;
};

} // namespace RTC
#endif
