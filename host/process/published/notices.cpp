// SPDX-License-Identifier: Apache-2.0
#include "host/process/published/notices.hpp"

#include "host/process/published/memory_file.hpp"

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

namespace tandem::process {
namespace {

MemoryFileOfProcess<Notices>& notices_file() {
    static auto* const file = new MemoryFileOfProcess<Notices>;
    return *file;
}

struct LastingNotices {
    std::mutex mutex;
    std::map<std::pair<NoticeKind, std::string>, std::unique_ptr<OwnNotice>> all;
};

} // namespace

OwnNotice::OwnNotice(NoticeKind kind, const std::string& text) {
    auto& file = notices_file();
    const std::lock_guard lock(file.mutex);
    if (file.content == nullptr) return;
    for (auto& place : file.content->place)
        if (place.kind == 0 && place_ == nullptr) place_ = &place;
    if (place_ == nullptr) return;
    place_->text[text.copy(place_->text, sizeof place_->text - 1)] = '\0';
    std::atomic_ref(place_->kind).store(static_cast<std::uint64_t>(kind), std::memory_order_release);
}

OwnNotice::~OwnNotice() {
    if (place_ == nullptr) return;
    const std::lock_guard lock(notices_file().mutex);
    std::atomic_ref(place_->kind).store(0, std::memory_order_release);
}

void publish_notice(NoticeKind kind, const std::string& text) {
    static auto* const lasting = new LastingNotices; // used by threads that outlive static objects
    const std::lock_guard lock(lasting->mutex);
    if (lasting->all.size() >= Notices::places) return;
    auto& notice = lasting->all[{kind, text}];
    if (!notice) notice = std::make_unique<OwnNotice>(kind, text);
}

} // namespace tandem::process
