// SPDX-License-Identifier: Apache-2.0
#include "host/rt/tick_page.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <cstring>
#include <mutex>

namespace tandem::rt {
namespace {

/// The page of this process; it is never unmapped, since ticks may end after static objects.
struct ProcessPage {
    std::mutex mutex;
    TickPage* page = nullptr;

    ProcessPage() {
        const int file = memfd_create(TickPage::file_name, MFD_CLOEXEC);
        if (file < 0) return;
        void* const at =
            ftruncate(file, sizeof(TickPage)) == 0
                ? mmap(nullptr, sizeof(TickPage), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, file, 0)
                : MAP_FAILED;
        if (at == MAP_FAILED) {
            close(file);
            return;
        }
        // The descriptor stays open: it is what others find.
        page = static_cast<TickPage*>(at);
        std::memcpy(page->magic, TickPage::magic_text, sizeof page->magic);
    }
};

ProcessPage& process_page() {
    static auto* const page = new ProcessPage;
    return *page;
}

} // namespace

OwnTickSlot::OwnTickSlot(const std::string& name, std::uint64_t period_ns) : slot_(&private_) {
    ProcessPage& mine = process_page();
    const std::lock_guard lock(mine.mutex);
    for (std::size_t i = 0; mine.page != nullptr && i < TickPage::slots && slot_ == &private_; ++i)
        if (mine.page->slot[i].period_ns == 0) slot_ = &mine.page->slot[i];
    *slot_ = {};
    name.copy(slot_->name, sizeof slot_->name - 1);
    std::atomic_ref(slot_->period_ns).store(period_ns, std::memory_order_release);
}

OwnTickSlot::~OwnTickSlot() {
    const std::lock_guard lock(process_page().mutex);
    std::atomic_ref(slot_->period_ns).store(0, std::memory_order_release);
}

} // namespace tandem::rt
