// SPDX-License-Identifier: Apache-2.0
// One message in a POSIX shared memory object, in the form of OpenRTM-aist's interface type shared_memory: its
// length as an unsigned long long, in the byte order that the two ends have agreed on, then its CDR. Both
// classes use pread() and pwrite() instead of a mapping: a peer that truncates the object, or a full /dev/shm,
// is then an error and not SIGBUS. Not synchronized.
#pragma once
#include <rtm/ByteData.h>
#include <string>

namespace RTC {

/// The object of the sending end; its name is removed with it.
class SharedMessageWriter {
  public:
    SharedMessageWriter() = default;
    ~SharedMessageWriter() { remove(); }
    SharedMessageWriter(const SharedMessageWriter&) = delete;
    SharedMessageWriter& operator=(const SharedMessageWriter&) = delete;

    /// Returns whether there is an object with room for a message of `length` bytes.
    bool fits(unsigned long length) const;
    /// Creates an object with a new name for messages of at least `length` bytes. Returns false if /dev/shm refuses it.
    bool create(unsigned long length);
    /// Writes the message. Returns false if there is no object, the message is too long for it, or /dev/shm is full.
    bool write(const ByteData& bytes);
    void remove();
    const std::string& name() const { return name_; }
    unsigned long long size() const { return size_; }

  private:
    std::string name_;
    unsigned long long size_ = 0;
    int descriptor_ = -1;
};

/// The receiving end's view of the object that a peer names. What is in it is not trusted.
class SharedMessageReader {
  public:
    SharedMessageReader() = default;
    ~SharedMessageReader() { close(); }
    SharedMessageReader(const SharedMessageReader&) = delete;
    SharedMessageReader& operator=(const SharedMessageReader&) = delete;

    /// Opens an object. Returns false, and sets errno, if the name is not a UUID as in OpenRTM-aist, or if there is no such object
    /// that this user may read.
    bool open(const std::string& name);
    void close();
    /// Copies the message in the object to `bytes`. Returns false if there is none, or if its length is more than the
    /// object holds. `little_endian`: the byte order of the length.
    bool read(ByteData& bytes, bool little_endian) const;
    /// Removes the name of the object that was opened last, whose creator does not do that.
    void remove_name();

  private:
    std::string name_;
    int descriptor_ = -1;
};

} // namespace RTC
