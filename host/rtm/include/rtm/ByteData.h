// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_BYTEDATA_H
#define RTC_BYTEDATA_H

namespace RTC {
class ByteDataStreamBase;

/// Owned bytes of one serialized message and their byte order. Memory is kept and reused: assigning or
/// writing allocates only when a message is longer than any before.
class ByteData {
  public:
    ByteData();
    ~ByteData();
    ByteData(const ByteData& other);
    ByteData(const ByteDataStreamBase& stream);
    ByteData& operator=(const ByteData& other);
    ByteData& operator=(const ByteDataStreamBase& stream);

    /// Copies `length` bytes out; asking for more than there is copies what there is.
    void readData(unsigned char* data, unsigned long length) const;
    void writeData(const unsigned char* data, unsigned long length);
    unsigned char* getBuffer() const { return m_buf; }
    unsigned long getDataLength() const { return m_len; }
    /// Sets the length; bytes up to it are kept, new ones are zero.
    void setDataLength(unsigned long length);
    void isLittleEndian(bool little_endian) { m_little_endian = little_endian; }
    bool getEndian() const { return m_little_endian; }

  private:
    void reserve(unsigned long length);

    unsigned char* m_buf = nullptr;
    unsigned long m_len = 0;
    unsigned long m_capacity = 0;
    bool m_little_endian = true;
};

} // namespace RTC
#endif
