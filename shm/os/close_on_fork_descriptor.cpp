// SPDX-License-Identifier: Apache-2.0
#include "shm/os/close_on_fork_descriptor.hpp"

#include "shm/os/error.hpp"

#include <fcntl.h>
#include <mutex>
#include <pthread.h>

namespace tandem::shm {

struct CloseOnForkDescriptor::List {
    std::mutex mutex; // held while the process forks, so that the child finds the list whole
    CloseOnForkDescriptor* first = nullptr;
};

// Outlives all static objects, because a process may fork() while those are destroyed.
CloseOnForkDescriptor::List& CloseOnForkDescriptor::list_of_this_library() {
    static constinit List list;
    return list;
}

CloseOnForkDescriptor::CloseOnForkDescriptor(const std::string& file, int flags)
    : CloseOnForkDescriptor([&] {
          FileDescriptor opened(::open(file.c_str(), flags));
          if (!opened)
              throw Error(file + ": cannot be opened (" + errno_text() + "); raise the limit on open files");
          return opened;
      }) {}

CloseOnForkDescriptor::CloseOnForkDescriptor(const std::function<FileDescriptor()>& open)
    : list_(list_of_this_library()) {
    static const int failure = pthread_atfork(before_fork, in_parent, in_child);
    if (failure != 0) throw Error("fork() cannot be watched (" + errno_text(failure) + "); free some memory");
    const std::lock_guard lock(list_.mutex); // nobody forks while the file is open and not in the list
    file_ = open();
    next_ = list_.first;
    if (next_ != nullptr) next_->previous_ = this;
    list_.first = this;
}

CloseOnForkDescriptor::~CloseOnForkDescriptor() {
    const std::lock_guard lock(list_.mutex);
    (previous_ != nullptr ? previous_->next_ : list_.first) = next_;
    if (next_ != nullptr) next_->previous_ = previous_;
    const FileDescriptor closed(std::move(file_));
}

void CloseOnForkDescriptor::before_fork() { list_of_this_library().mutex.lock(); }

void CloseOnForkDescriptor::in_parent() { list_of_this_library().mutex.unlock(); }

void CloseOnForkDescriptor::in_child() {
    List& list = list_of_this_library();
    for (auto* owner = list.first; owner != nullptr; owner = owner->next_)
        const FileDescriptor closed(std::move(owner->file_));
    list.mutex.unlock();
}

} // namespace tandem::shm
