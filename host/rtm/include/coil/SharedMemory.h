// SPDX-License-Identifier: Apache-2.0
#ifndef COIL_SHAREDMEMORY_H
#define COIL_SHAREDMEMORY_H
#include <string>

#define DEFAULT_MEMORY_SIZE 2097152

namespace coil {

/// A named POSIX shared memory object of a fixed size. Functions that can fail return 0 or -1. The creator removes
/// the object's name in its destructor.
class SharedMemory {
  public:
    SharedMemory() = default;
    virtual ~SharedMemory();
    SharedMemory(const SharedMemory&) = delete;
    SharedMemory& operator=(const SharedMemory&) = delete;

    /// Creates an object that only this user can read and write.
    virtual int create(std::string shm_address, unsigned long long memory_size = DEFAULT_MEMORY_SIZE);
    /// Returns -1 also if the object is smaller than `memory_size`.
    virtual int open(std::string shm_address, unsigned long long memory_size = DEFAULT_MEMORY_SIZE);
    virtual int write(const char* data, unsigned long long pos, unsigned long long size);
    virtual int read(char* data, unsigned long long pos, unsigned long long size);
    virtual int close();
    virtual int unlink();
    virtual unsigned long long get_size() { return m_size; }
    virtual std::string get_addresss() { return m_address; }
    virtual char* get_data() { return m_data; }
    virtual bool created() { return m_created; }

  private:
    int map(int descriptor, unsigned long long size, const std::string& address);
    bool within(unsigned long long pos, unsigned long long size) const {
        return m_data != nullptr && pos <= m_size && size <= m_size - pos;
    }

    std::string m_address;
    unsigned long long m_size = 0;
    char* m_data = nullptr;
    bool m_created = false;
};

} // namespace coil
#endif
