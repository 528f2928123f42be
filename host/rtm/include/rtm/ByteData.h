// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_BYTEDATA_H
#define RTC_BYTEDATA_H

namespace RTC {
class ByteDataStreamBase;

/// The bytes of one serialized message and their byte order. Keeps and reuses its memory: assigning or writing
/// allocates only if a message is longer than all previous ones. Not synchronized.
class ByteData {
  public:
    ByteData();
    ~ByteData();
    ByteData(const ByteData& other);
    ByteData(const ByteDataStreamBase& stream);
    ByteData& operator=(const ByteData& other);
    ByteData& operator=(const ByteDataStreamBase& stream);

    /// Copies `length` bytes to `data`, or all bytes if there are fewer.
    void readData(unsigned char* data, unsigned long length) const;
    /// Replaces the content.
    void writeData(const unsigned char* data, unsigned long length);
    unsigned char* getBuffer() const { return m_buf; }
    unsigned long getDataLength() const { return m_len; }
    /// Sets the length. Keeps existing bytes up to it; new bytes are zero.
    void setDataLength(unsigned long length);
    void isLittleEndian(bool little_endian) { m_little_endian = little_endian; }
    /// Returns true if the data are little-endian.
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
