// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_OUTPORTCONNECTOR_H
#define RTC_OUTPORTCONNECTOR_H
#include <rtm/ConnectorListener.h>
#include <rtm/DirectBuffer.h>
#include <rtm/InPlaceBuffer.h>
#include <rtm/Timestamp.h>

namespace RTC {

/// The sending end of a data connection, owned by its OutPort, which writes it from one thread at a time.
/// Values go through the serializer of the connection's marshaling type (CDR unless it names another), except
/// for the two short cuts: as they are into a DirectBuffer, or encoded straight into an InPlaceBuffer.
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

    /// Sends what `stream` holds, which must be in the connector's byte order.
    virtual DataPortStatus write(ByteDataStreamBase* stream);
    /// Sends bytes that are already serialized (they say their byte order themselves).
    virtual DataPortStatus write(ByteData& bytes) = 0;
    /// Sends a value. PORT_ERROR: it cannot be serialized; else what the receiver or the buffer has made of
    /// it. Ours: a warm-up (Marshal::isWarmUp()) sends nothing, and goes as far as an InPlaceBuffer.
    template <class DataType>
    [[gnu::hot]] DataPortStatus write(DataType& data, bool warm_up = false) {
        if (warm_up && m_bytes.getDataLength() < m_minInPlaceLength) return DataPortStatus::PORT_OK;
        auto* stream = m_serializer.get<DataType>(m_marshaling_type, m_profile.name, rtclog);
        if (stream == nullptr) return DataPortStatus::PORT_ERROR;
        const bool stamps =
            m_timestamp == TimestampPolicy::on_write || m_timestamp == TimestampPolicy::on_send;
        m_sentInPlace = false;
        if (m_direct && !stamps && !warm_up) {
            DataPortStatus status = DataPortStatus::PORT_OK;
            m_sentInPlace = writeDirect({typeid(DataType), &data}, status);
            if (m_sentInPlace) return status;
        }
        // The length of this message is not known before it is encoded: the last one's serves as a guess.
        if (m_bytes.getDataLength() >= m_minInPlaceLength && m_serializer.isStandardCdr() && m_littleEndian &&
            !stamps) {
            DataPortStatus status = DataPortStatus::PORT_OK;
            m_sentInPlace = writeInPlace(CdrMarshal<DataType>(data, warm_up), status);
            if (m_sentInPlace) return status;
        }
        if (warm_up) return DataPortStatus::PORT_OK;
        stream->isLittleEndian(isLittleEndian());
        bool serialized = false;
        if (stamps) {
            DataType stamped(data); // the component's variable stays as it is
            stampIfPossible(stamped, 0);
            serialized = stream->serialize(stamped);
        } else {
            serialized = stream->serialize(data);
        }
        return serialized ? write(static_cast<ByteDataStreamBase*>(stream)) : DataPortStatus::PORT_ERROR;
    }

    /// Takes the oldest message that waits for the peer: for the OutPortProvider of a library, which calls
    /// the listeners itself. PRECONDITION_NOT_MET: this connector keeps none.
    virtual BufferStatus read(ByteData& bytes);

    virtual void setEndian(bool little_endian) { m_littleEndian = little_endian; }
    virtual bool isLittleEndian() { return m_littleEndian; }
    /// Ours: would this connector send the very bytes that `other` has sent last? Byte order and marshaling
    /// type are the same, neither stamps, and there were bytes.
    bool canShareBytesOf(const OutPortConnector& other) const;
    /// Ours: was the last value encoded straight into the receiver's buffer, as each one can be?
    bool writesInPlace() const {
        return m_sentInPlace && !m_direct && m_minInPlaceLength == 0 && m_littleEndian;
    }
    /// Ours: the bytes of the last write of a value; valid when canShareBytesOf() said so.
    ByteData& serializedBytes() { return m_bytes; }

  protected:
    /// Ours: encodes a message straight into the receiver's buffer. Returns false if it is short or the receiver
    /// has no InPlaceBuffer; nothing has happened then.
    virtual bool writeInPlace(const Marshal& marshal, DataPortStatus& status);

    /// Ours: hands a value to an InPort of this process without serializing it. False as above.
    virtual bool writeDirect(const DirectValue& message, DataPortStatus& status);

    Logger rtclog{"OutPortConnector"};
    ConnectorInfo m_profile;
    bool m_littleEndian = true;
    ConnectorListenersBase* m_listeners;
    std::string m_marshaling_type;
    TimestampPolicy m_timestamp;

    unsigned long m_minInPlaceLength =
        static_cast<unsigned long>(-1); // of the InPlaceBuffer, if there is one
    bool m_direct = false;              // the receiver has a DirectBuffer

  private:
    bool m_sentInPlace = false;
    ByteData m_bytes;
    ConnectorSerializer m_serializer;
};

} // namespace RTC
#endif
