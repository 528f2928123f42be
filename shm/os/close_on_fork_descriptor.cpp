// SPDX-License-Identifier: Apache-2.0
#include "shm/os/close_on_fork_descriptor.hpp"

#include "shm/os/error.hpp"

#include <fcntl.h>
#include <mutex>
#include <pthread.h>

namespace tandem::shm {
namespace {

// Both outlive all static objects, because a process may fork() while those are destroyed.
constinit std::mutex list_mutex; // held while the process forks, so that the child finds a consistent list
constinit CloseOnForkDescriptor* first = nullptr;

} // namespace

CloseOnForkDescriptor::CloseOnForkDescriptor(const std::string& file, int flags) {
    static const int failure = pthread_atfork(before_fork, in_parent, in_child);
    if (failure != 0) throw Error("fork() cannot be watched (" + errno_text(failure) + "); free some memory");
    const std::lock_guard lock(list_mutex); // no fork() happens while the file is open but not in the list
    file_ = FileDescriptor(::open(file.c_str(), flags));
    if (!file_)
        throw Error(file + ": cannot be opened (" + errno_text() + "); raise the limit on open files");
    next_ = first;
    if (first != nullptr) first->previous_ = this;
    first = this;
}

CloseOnForkDescriptor::~CloseOnForkDescriptor() {
    const std::lock_guard lock(list_mutex);
    (previous_ != nullptr ? previous_->next_ : first) = next_;
    if (next_ != nullptr) next_->previous_ = previous_;
    const FileDescriptor closed(std::move(file_));
}

void CloseOnForkDescriptor::before_fork() { list_mutex.lock(); }

void CloseOnForkDescriptor::in_parent() { list_mutex.unlock(); }

void CloseOnForkDescriptor::in_child() {
    for (auto* owner = first; owner != nullptr; owner = owner->next_)
        const FileDescriptor closed(std::move(owner->file_));
    list_mutex.unlock();
}

} // namespace tandem::shm
