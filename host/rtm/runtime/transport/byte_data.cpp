// SPDX-License-Identifier: Apache-2.0
// Serialized messages: ByteData, ByteDataStreamBase, CORBA_CdrMemoryStream; and the global factories of
// buffers and serializers, instantiated here so that all libraries of a process share one instance.
#include <algorithm>
#include <cstring>
#include <rtm/ByteData.h>
#include <rtm/CORBA_CdrMemoryStream.h>
#include <rtm/CdrBufferBase.h>

template class coil::GlobalFactory<RTC::CdrBufferBase>;
template class coil::Factory<RTC::ByteDataStreamBase>;
template class coil::GlobalFactory<RTC::ByteDataStreamBase>;

namespace RTC {

ByteData::ByteData() = default;
ByteData::~ByteData() { delete[] m_buf; }
ByteData::ByteData(const ByteData& other) { *this = other; }
ByteData::ByteData(const ByteDataStreamBase& stream) { *this = stream; }

ByteData& ByteData::operator=(const ByteData& other) {
    if (this == &other) return *this;
    writeData(other.m_buf, other.m_len);
    m_little_endian = other.m_little_endian;
    return *this;
}

// The byte order does not change, because a stream does not carry it.
ByteData& ByteData::operator=(const ByteDataStreamBase& stream) {
    const unsigned long length = stream.getDataLength();
    reserve(length);
    m_len = length;
    if (length > 0) stream.readData(m_buf, length);
    return *this;
}

void ByteData::reserve(unsigned long length) {
    if (length <= m_capacity) return;
    // Doubles the size, so that a port whose messages grow slowly does not allocate for each message.
    const unsigned long capacity = std::max(length, 2 * m_capacity);
    auto* grown = new unsigned char[capacity];
    copyBytes(grown, m_buf, m_len);
    delete[] m_buf;
    m_buf = grown;
    m_capacity = capacity;
}

void ByteData::readData(unsigned char* data, unsigned long length) const {
    const unsigned long n = std::min(length, m_len);
    copyBytes(data, m_buf, n);
}

void ByteData::writeData(const unsigned char* data, unsigned long length) {
    reserve(length);
    copyBytes(m_buf, data, length);
    m_len = length;
}

void ByteData::setDataLength(unsigned long length) {
    reserve(length);
    // Never returns bytes of an earlier message.
    if (length > m_len) std::memset(m_buf + m_len, 0, length - m_len);
    m_len = length;
}

ByteDataStreamBase::~ByteDataStreamBase() = default;
void ByteDataStreamBase::init(const coil::Properties&) {}
void ByteDataStreamBase::isLittleEndian(bool) {}

std::vector<std::string> detail::marshalingTypes(const std::string& prefix) {
    std::vector<std::string> types;
    for (const auto& id : SerializerFactory::instance().getIdentifiers())
        if (id.compare(0, prefix.size(), prefix) == 0) types.push_back(id.substr(prefix.size()));
    return types;
}

const unsigned char* CORBA_CdrMemoryStream::getBuffer() {
    return static_cast<const unsigned char*>(m_cdr.bufPtr());
}
unsigned long CORBA_CdrMemoryStream::getCdrDataLength() const { return m_cdr.bufSize(); }

// omniORB's stream marshals in this machine's byte order unless told to swap; its flag says which order the
// bytes have (true: little-endian).
void CORBA_CdrMemoryStream::writeCdrData(const unsigned char* buffer, unsigned long length) {
    m_cdr.rewindPtrs();
    m_cdr.setByteSwapFlag(m_endian);
    m_cdr.put_octet_array(buffer, static_cast<int>(length));
}

void CORBA_CdrMemoryStream::readCdrData(unsigned char* buffer, unsigned long length) const {
    const unsigned long n = std::min<unsigned long>(length, m_cdr.bufSize());
    copyBytes(buffer, m_cdr.bufPtr(), n);
}

} // namespace RTC
