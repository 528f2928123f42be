// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_BYTEDATASTREAMBASE_H
#define RTC_BYTEDATASTREAMBASE_H
#include <algorithm>
#include <coil/Factory.h>
#include <coil/Properties.h>
#include <rtm/Typename.h>
#include <string>
#include <vector>

namespace RTC {

/// Serialized bytes as a connector handles them: writeData() puts bytes in, readData() takes them out.
class ByteDataStreamBase {
  public:
    ByteDataStreamBase() = default;
    virtual ~ByteDataStreamBase();
    virtual void init(const coil::Properties& prop);
    virtual void writeData(const unsigned char* buffer, unsigned long length) = 0;
    virtual void readData(unsigned char* buffer, unsigned long length) const = 0;
    virtual unsigned long getDataLength() const = 0;
    virtual void isLittleEndian(bool little_endian);
};

/// Values of one type to bytes and back.
template <typename DataType>
class ByteDataStream : public ByteDataStreamBase {
  public:
    virtual bool serialize(const DataType& data) = 0;
    virtual bool deserialize(DataType& data) = 0;
};

/// By `<repository id>:<marshaling type>`.
using SerializerFactory = coil::GlobalFactory<ByteDataStreamBase>;

template <class DataType>
std::string addDataTypeToMarshalingType(const std::string& marshalingtype) {
    return std::string(CORBA_Util::toRepositoryId<DataType>()) + ":" + marshalingtype;
}
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
template <class DataType>
ByteDataStreamBase* createSerializer(const std::string& marshalingtype) {
    return SerializerFactory::instance().createObject(addDataTypeToMarshalingType<DataType>(marshalingtype));
}
template <class DataType>
std::vector<std::string> getSerializerList() {
    const std::string prefix = addDataTypeToMarshalingType<DataType>("");
    std::vector<std::string> types;
    for (const auto& id : SerializerFactory::instance().getIdentifiers())
        if (id.compare(0, prefix.size(), prefix) == 0) types.push_back(id.substr(prefix.size()));
    return types;
}

} // namespace RTC

extern template class coil::GlobalFactory<RTC::ByteDataStreamBase>;
#endif
