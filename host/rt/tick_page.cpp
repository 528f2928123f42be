// SPDX-License-Identifier: Apache-2.0
#include "host/rt/tick_page.hpp"

#include "host/process/published/memory_file.hpp"

#include <mutex>

namespace tandem::rt {
namespace {

/// The page of this process. It is never unmapped, because ticks may end after static objects are destroyed.
struct ProcessPage {
    std::mutex mutex;
    process::MemoryFile<TickPage> file;
    TickPage* page = file.get();
};

ProcessPage& process_page() {
    static auto* const page = new ProcessPage;
    return *page;
}

} // namespace

OwnTickSlot::OwnTickSlot(const std::string& name, std::uint64_t period_ns) {
    ProcessPage& mine = process_page();
    const std::lock_guard lock(mine.mutex);
    for (std::size_t i = 0; mine.page != nullptr && i < TickPage::slots && slot_ == nullptr; ++i)
        if (mine.page->slot[i].period_ns == 0) slot_ = &mine.page->slot[i];
    if (slot_ == nullptr) {
        private_ = std::make_unique<TickSlot>();
        slot_ = private_.get();
        unseen_.emplace(process::NoticeKind::unseen, "the ticks of " + name + " are not shown: those of " +
                                                         std::to_string(TickPage::slots) + " others are");
    }
    *slot_ = {};
    name.copy(slot_->name, sizeof slot_->name - 1);
    std::atomic_ref(slot_->period_ns).store(period_ns, std::memory_order_release);
}

OwnTickSlot::~OwnTickSlot() {
    const std::lock_guard lock(process_page().mutex);
    std::atomic_ref(slot_->period_ns).store(0, std::memory_order_release);
}

} // namespace tandem::rt
