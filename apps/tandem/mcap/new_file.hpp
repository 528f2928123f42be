// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/records.hpp"

#include <filesystem>

namespace tandem::mcap {

/// A file that replaces no other file and that no second program writes: it is locked (flock(2)) before it has its
/// name. Also accepts an empty file, which it locks, and a device or pipe. Errors are one line with the file and the
/// cause. [one thread]
class NewFile {
  public:
    /// When the file gets its name. Until then it is FOLDER/tandem-PID-N.part.
    enum class Named {
        at_once,      ///< for a recording: if the recorder is killed, the user finds the data
        when_complete ///< for a file that can be recreated: an incomplete one never has the name
    };
    /// Throws Error if the name is taken by a file that is not empty or that another program is writing.
    NewFile(std::filesystem::path path, Named named);
    ~NewFile(); ///< Closes the file. Removes it if it has no name yet.
    NewFile(const NewFile&) = delete;
    NewFile& operator=(const NewFile&) = delete;

    int descriptor() const { return descriptor_; }
    bool is_regular() const { return regular_; } ///< not a device or pipe
    /// Gives the file its name and closes it. Throws Error, for example if another file has taken the name.
    void close();
    /// Closes the file and removes it. An empty file that existed before becomes empty again.
    void discard();
    /// Returns the Error for an errno value of writing.
    Error error(int cause) const;

  private:
    void create();
    void open_existing();
    bool lock() const; ///< Returns false if another program has locked the file.
    void give_name();
    [[noreturn]] void refuse() const;

    const std::filesystem::path path_;
    std::filesystem::path temporary_; ///< empty: the file has its name
    int descriptor_ = -1;
    bool regular_ = true, created_ = false;
};

} // namespace tandem::mcap
