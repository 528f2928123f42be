// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_BYTEDATASTREAMBASE_H
#define RTC_BYTEDATASTREAMBASE_H
#include <coil/Factory.h>
#include <coil/Properties.h>
#include <rtm/Typename.h>
#include <string>
#include <vector>

namespace RTC {

/// The interface of a serializer to connectors: writeData() takes the bytes to decode, readData() copies the encoded
/// bytes. Not synchronized: each connector has its own serializer.
class ByteDataStreamBase {
  public:
    ByteDataStreamBase() = default;
    virtual ~ByteDataStreamBase();
    virtual void init(const coil::Properties& prop);
    virtual void writeData(const unsigned char* buffer, unsigned long length) = 0;
    virtual void readData(unsigned char* buffer, unsigned long length) const = 0;
    virtual unsigned long getDataLength() const = 0;
    /// Sets the byte order of the following data.
    virtual void isLittleEndian(bool little_endian);
};

/// A serializer for values of one type. Both functions return false on failure. Users derive from it and register it
/// with addSerializer().
template <typename DataType>
class ByteDataStream : public ByteDataStreamBase {
  public:
    virtual bool serialize(const DataType& data) = 0;
    virtual bool deserialize(DataType& data) = 0;
};

} // namespace RTC

extern template class coil::Factory<RTC::ByteDataStreamBase>;
extern template class coil::GlobalFactory<RTC::ByteDataStreamBase>;

namespace RTC {

/// All serializers of the process, by `<repository id>:<marshaling type>`.
using SerializerFactory = coil::GlobalFactory<ByteDataStreamBase>;

template <class DataType>
std::string addDataTypeToMarshalingType(const std::string& marshalingtype) {
    return std::string(CORBA_Util::toRepositoryId<DataType>()) + ":" + marshalingtype;
}
/// Registers a serializer for connections whose `marshaling_type` names it.
template <class DataType, class SerializerType>
void addSerializer(const std::string& marshalingtype) {
    SerializerFactory::instance().addFactory(addDataTypeToMarshalingType<DataType>(marshalingtype),
                                             coil::Creator<ByteDataStreamBase, SerializerType>,
                                             coil::Destructor<ByteDataStreamBase, SerializerType>);
}
template <class DataType>
void removeSerializer(const std::string& marshalingtype) {
    SerializerFactory::instance().removeFactory(addDataTypeToMarshalingType<DataType>(marshalingtype));
}
/// Returns NULL if there is none. Return the serializer with SerializerFactory::deleteObject().
template <class DataType>
ByteDataStreamBase* createSerializer(const std::string& marshalingtype) {
    return SerializerFactory::instance().createObject(addDataTypeToMarshalingType<DataType>(marshalingtype));
}
namespace detail {
/// Returns what follows `prefix` in the names of all serializers that begin with it.
std::vector<std::string> marshalingTypes(const std::string& prefix);
} // namespace detail
/// Returns the marshaling types that are available for a data type.
template <class DataType>
std::vector<std::string> getSerializerList() {
    return detail::marshalingTypes(addDataTypeToMarshalingType<DataType>(""));
}

} // namespace RTC
#endif
