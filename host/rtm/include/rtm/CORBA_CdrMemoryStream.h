// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_CORBA_CDRMEMORYSTREAM_H
#define RTC_CORBA_CDRMEMORYSTREAM_H
#include <cstdint>
#include <cstring>
#include <rtm/ByteData.h>
#include <rtm/ByteDataStreamBase.h>
#include <rtm/CopyBytes.h>
#include <rtm/InPlaceBuffer.h>
#include <rtm/RTC.h>
#include <rtm/SystemLogger.h>
#include <rtm/idl/BasicDataTypeSkel.h>
#include <rtm/idl/DataPort_OpenRTMSkel.h>
#include <rtm/idl/ExtendedDataTypesSkel.h>
#include <rtm/idl/InterfaceDataTypesSkel.h>
#include <type_traits>
#include <typeinfo>
#include <utility>

namespace RTC {

/// Encodes and decodes one message as CDR (OMG CORBA 3.3, part 2, 9.3), aligned from its first byte, without the
/// byte-order octet of an encapsulation, like OpenRTM-aist. Keeps its memory between messages.
class CORBA_CdrMemoryStream {
  public:
    template <class DataType>
    bool serializeCDR(const DataType& data) {
        try {
            m_cdr.rewindPtrs();
            m_cdr.setByteSwapFlag(m_endian);
            data >>= m_cdr;
            return true;
        } catch (const CORBA::SystemException&) { // a sequence over its bound, a char outside the code set
            return false;
        }
    }
    template <class DataType>
    bool deserializeCDR(DataType& data) {
        try {
            data <<= m_cdr;
            return true;
        } catch (const CORBA::SystemException&) { // the bytes are not such a message
            return false;
        }
    }
    /// Call it before encoding and before writeCdrData().
    void setEndian(bool little_endian) { m_endian = little_endian; }
    const unsigned char* getBuffer();
    unsigned long getCdrDataLength() const;
    cdrMemoryStream& getCdr() { return m_cdr; }
    void writeCdrData(const unsigned char* buffer, unsigned long length);
    void readCdrData(unsigned char* buffer, unsigned long length) const;

  private:
    cdrMemoryStream m_cdr;
    bool m_endian = true;
};

/// The serializer of the marshaling type `cdr`.
template <class DataType>
class CORBA_CdrSerializer : public ByteDataStream<DataType> {
  public:
    void writeData(const unsigned char* buffer, unsigned long length) override {
        m_cdr.writeCdrData(buffer, length);
    }
    void readData(unsigned char* buffer, unsigned long length) const override {
        m_cdr.readCdrData(buffer, length);
    }
    unsigned long getDataLength() const override { return m_cdr.getCdrDataLength(); }
    void isLittleEndian(bool little_endian) override { m_cdr.setEndian(little_endian); }
    bool serialize(const DataType& data) override { return m_cdr.serializeCDR(data); }
    bool deserialize(DataType& data) override { return m_cdr.deserializeCDR(data); }

  protected:
    CORBA_CdrMemoryStream m_cdr;
};

/// Ours: the serializer of a connector, created at the first message. A connector's type does not change afterwards.
/// [one thread at a time]
class ConnectorSerializer {
  public:
    ConnectorSerializer() = default;
    ConnectorSerializer(const ConnectorSerializer&) = delete;
    ~ConnectorSerializer() { SerializerFactory::instance().deleteObject(m_made); }

    /// Returns NULL if there is no serializer of this marshaling type for values of this type, and logs it once.
    template <class DataType>
    ByteDataStream<DataType>* get(const std::string& marshaling_type, const std::string& connector,
                                  Logger& rtclog) {
        // Compares the address first, which is equal within a library and needs no string comparison.
        if (m_type != &typeid(DataType) && (m_type == nullptr || *m_type != typeid(DataType)))
            make<DataType>(marshaling_type, connector, rtclog);
        return static_cast<ByteDataStream<DataType>*>(m_typed);
    }
    /// Returns true for Tandem's own serializer, which CdrMarshal and CdrUnmarshal may replace.
    bool isStandardCdr() const { return m_isStandardCdr; }

  private:
    template <class DataType>
    void make(const std::string& marshaling_type, const std::string& connector, Logger& rtclog) {
        SerializerFactory::instance().deleteObject(m_made);
        m_made = createSerializer<DataType>(marshaling_type);
        m_typed = dynamic_cast<ByteDataStream<DataType>*>(m_made);
        m_type = &typeid(DataType);
        m_isStandardCdr = m_made != nullptr && typeid(*m_made) == typeid(CORBA_CdrSerializer<DataType>);
        if (m_typed == nullptr)
            RTC_ERROR(("connector %s: no serializer for marshaling type %s", connector.c_str(),
                       marshaling_type.c_str()));
    }

    ByteDataStreamBase* m_made = nullptr;
    void* m_typed = nullptr; // m_made as ByteDataStream<DataType>*
    const std::type_info* m_type = nullptr;
    bool m_isStandardCdr = false;
};

namespace detail {

/// The elements of a sequence whose CDR is their bytes. Excludes bool and char, which CDR checks and translates.
template <class Sequence>
using NumberOf = typename std::remove_reference<decltype(*std::declval<Sequence&>().get_buffer())>::type;
template <class T>
struct is_number
    : std::integral_constant<bool, std::is_arithmetic<T>::value && !std::is_same<T, bool>::value &&
                                       !std::is_same<T, char>::value && !std::is_same<T, wchar_t>::value &&
                                       sizeof(T) <= 8> {};

/// To C++, a CORBA::Char is a number like an octet. Only the class of the sequence distinguishes them.
template <class Sequence>
struct is_char_sequence : std::is_base_of<_CORBA_Sequence_Char, Sequence> {};

/// Tests for exactly `struct { Time tm; sequence<a number> data; }`.
template <class DataType, class = void>
struct is_timed_numbers : std::false_type {};
template <class DataType>
struct is_timed_numbers<DataType,
                        typename std::enable_if<std::is_same<decltype(DataType::tm), Time>::value &&
                                                is_number<NumberOf<decltype(DataType::data)>>::value &&
                                                !is_char_sequence<decltype(DataType::data)>::value>::type> {
    struct Form {
        Time tm;
        decltype(DataType::data) data;
    };
    static const bool value = sizeof(DataType) == sizeof(Form);
    typedef std::integral_constant<bool, value> type;
};

template <class DataType> // const or not
using NumbersOf =
    TimedNumbers<typename std::conditional<std::is_const<DataType>::value, const void, void>::type>;
template <class DataType>
NumbersOf<DataType> timed_numbers(DataType&, std::false_type) {
    return {nullptr, nullptr, 0, 0};
}
template <class DataType>
NumbersOf<DataType> timed_numbers(DataType& data, std::true_type) {
    // CDR has the time first.
    const bool time_first = static_cast<const void*>(&data.tm) == static_cast<const void*>(&data);
    auto* elements = data.data.NP_data();
    return {time_first ? &data.tm : nullptr, elements, data.data.length(), sizeof(*elements)};
}

template <class DataType>
bool decode_timed_numbers(const ByteData&, DataType&, std::false_type) {
    return false;
}
template <class DataType>
bool decode_timed_numbers(const ByteData& bytes, DataType& data, std::true_type) {
    const std::uint64_t element_bytes = sizeof(*data.data.NP_data()), time_bytes = sizeof(Time);
    const std::uint64_t head = element_bytes == 8 ? time_bytes + 8 : time_bytes + 4; // the count and padding
    const bool time_first = static_cast<const void*>(&data.tm) == static_cast<const void*>(&data);
    const bool native = bytes.getEndian() == (__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);
    const unsigned char* const in = bytes.getBuffer();
    CORBA::ULong count = 0;
    if (!time_first || !native || bytes.getDataLength() <= head) return false;
    std::memcpy(&count, in + time_bytes, sizeof count);
    if (bytes.getDataLength() != head + count * element_bytes) return false;
    try {
        data.data.length(count);
    } catch (const CORBA::SystemException&) { // more than the type's bound
        return false;
    }
    std::memcpy(&data.tm, in, sizeof data.tm);
    copyBytes(data.data.NP_data(), in + head, count * element_bytes);
    return true;
}
/// Decodes like deserializeCDR(), but without the memory and calls of a stream, if the message is a time and numbers
/// in this machine's byte order. Otherwise returns false and leaves the value unspecified.
template <class DataType>
bool decode_timed_numbers(const ByteData& bytes, DataType& data) {
    return decode_timed_numbers(bytes, data, typename is_timed_numbers<DataType>::type());
}

} // namespace detail

/// Encodes one value into an InPlaceBuffer. Refers to the value, which must outlive it.
template <class DataType>
class CdrMarshal final : public Marshal {
  public:
    explicit CdrMarshal(const DataType& data)
        : Marshal(detail::timed_numbers(data, typename detail::is_timed_numbers<DataType>::type())),
          m_data(data) {}
    bool operator()(cdrStream& out) const override {
        try {
            m_data >>= out;
            return true;
        } catch (const CORBA::SystemException&) {
            return false;
        }
    }

  private:
    const DataType& m_data;
};

/// Decodes one value in an InPlaceBuffer. Sets `valid` to false if the bytes are not such a value.
template <class DataType>
class CdrUnmarshal final : public Unmarshal {
  public:
    explicit CdrUnmarshal(DataType& data)
        : Unmarshal(detail::timed_numbers(data, typename detail::is_timed_numbers<DataType>::type())),
          m_data(data) {}
    void operator()(cdrStream& in) override {
        try {
            m_data <<= in;
        } catch (const CORBA::SystemException&) { // the bytes are not such a message
            valid = false;
        }
    }
    bool valid = true;

  private:
    DataType& m_data;
};

} // namespace RTC

/// Makes the marshaling type `cdr` available for a data type. Ports call it for their types.
template <class DataType>
void CdrMemoryStreamInit() {
    ::RTC::addSerializer<DataType, ::RTC::CORBA_CdrSerializer<DataType>>("cdr");
}
#endif
