// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/os/file_descriptor.hpp"

#include <functional>
#include <string>

namespace tandem::shm {

/// Owns a file descriptor that a fork()ed child does not inherit, like O_CLOFORK of POSIX.1-2024, which Linux lacks. Children
/// of clone() and _Fork(), which run no pthread_atfork() handlers, keep the descriptor until they call exec().
class CloseOnForkDescriptor {
  public:
    /// Opens the file with the flags of open(2). Throws Error.
    CloseOnForkDescriptor(const std::string& file, int flags);
    /// Owns the descriptor that `open` returns. `open` runs while no thread of the process forks, and may throw. Throws
    /// Error.
    explicit CloseOnForkDescriptor(const std::function<FileDescriptor()>& open);
    ~CloseOnForkDescriptor();
    CloseOnForkDescriptor(const CloseOnForkDescriptor&) = delete;
    CloseOnForkDescriptor& operator=(const CloseOnForkDescriptor&) = delete;

    explicit operator bool() const {
        return static_cast<bool>(file_);
    } ///< Returns false in a fork()ed child.
    int get() const { return file_.get(); }

  private:
    /// The descriptors of this process, for the child of a fork(). The proxy's plugins and the RTM runtime have a list each, and the
    /// linker may take a destructor from another one of them: so each object knows its list.
    struct List;
    static List& list_of_this_library();
    static void before_fork();
    static void in_parent();
    static void in_child();

    FileDescriptor file_;
    List& list_;
    CloseOnForkDescriptor *previous_ = nullptr, *next_;
};

} // namespace tandem::shm
