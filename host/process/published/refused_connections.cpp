// SPDX-License-Identifier: Apache-2.0
#include "host/process/published/refused_connections.hpp"

#include "host/process/published/memory_file.hpp"

#include <atomic>
#include <mutex>

namespace tandem::process {
namespace {

MemoryFileOfProcess<RefusedConnections>& refused_file() {
    static auto* const file = new MemoryFileOfProcess<RefusedConnections>;
    return *file;
}

template <std::size_t Size>
void copy_text(char (&to)[Size], const std::string& text) {
    to[text.copy(to, Size - 1)] = '\0';
}

} // namespace

OwnRefusedConnection::OwnRefusedConnection(const std::string& from, const std::string& to,
                                           const std::string& reason) {
    auto& file = refused_file();
    const std::lock_guard lock(file.mutex);
    for (std::size_t i = 0; file.content != nullptr && i < RefusedConnections::places && !place_; ++i)
        if (file.content->place[i].taken == 0) place_ = &file.content->place[i];
    if (!place_) return;
    copy_text(place_->from, from);
    copy_text(place_->to, to);
    copy_text(place_->reason, reason);
    std::atomic_ref(place_->taken).store(1, std::memory_order_release);
}

OwnRefusedConnection::~OwnRefusedConnection() {
    if (!place_) return;
    const std::lock_guard lock(refused_file().mutex);
    std::atomic_ref(place_->taken).store(0, std::memory_order_release);
}

} // namespace tandem::process
