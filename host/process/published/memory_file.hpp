// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <boost/interprocess/mapped_region.hpp>
#include <cstddef>
#include <cstring>
#include <mutex>

namespace tandem::process {

/// Creates and maps a memory file. Other processes of the same user find it by `name` as /proc/PID/fd/N until this process
/// ends. Returns an empty region if the system does not permit it. [any-thread]
boost::interprocess::mapped_region create_memory_file(const char* name, std::size_t bytes);

/// A memory file named File::file_name for one File. Its `magic` is `magic_text`; all other bytes are zero at first.
template <class File>
class MemoryFile {
  public:
    MemoryFile() : region_(create_memory_file(File::file_name, sizeof(File))) {
        if (get() != nullptr) std::memcpy(get()->magic, File::magic_text, sizeof get()->magic);
    }
    /// Returns nullptr if the system does not permit memory files.
    File* get() const { return static_cast<File*>(region_.get_address()); }

  private:
    boost::interprocess::mapped_region region_;
};

/// The one file of a type in this process, for objects that each take a place in it. Made with new and never deleted,
/// because these objects may end after static objects are destroyed.
template <class File>
struct MemoryFileOfProcess {
    std::mutex mutex; ///< for taking and leaving a place
    MemoryFile<File> memory;
    File* const content = memory.get(); ///< nullptr if the system does not permit memory files
};

} // namespace tandem::process
