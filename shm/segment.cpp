// SPDX-License-Identifier: Apache-2.0
#include "shm/segment.hpp"

#include "shm/os/futex_timeout_thread.hpp"
#include "shm/os/shared_copy.hpp"
#include "shm/segment/liveness.hpp"

#include <optional>

namespace tandem::shm {

Segment::Segment(std::shared_ptr<const Mapping> mapping, std::unique_ptr<CloseOnForkDescriptor> life_lock)
    : mapping_(std::move(mapping)), directory_(mapping_), doorbell_(mapping_, mapping_->side()),
      peer_doorbell_(mapping_, other(mapping_->side())), life_lock_(std::move(life_lock)) {}

Segment::~Segment() { leave(); }

void Segment::leave() {
    // A fork()ed child has no lock: its parent owns the side.
    if (!*life_lock_ || left_.exchange(true)) return;
    const int fd = life_lock_->get();
    // If the hand-over byte is not available (its holder was stopped), the file is left to remove_dead(). Nobody can join a
    // file without a name, so this thread does not wait for the byte then.
    std::optional<HandOverLock> hand_over;
    if (still_named(fd)) hand_over.emplace(fd);
    mapping_->side_header(side()).left.store(1, std::memory_order_relaxed);
    unlock(fd, life_byte(side()));
    if (hand_over && hand_over->held() && !side_lives(fd, other(side())) && still_named(fd))
        ::unlink(path().c_str());
    announce_change(fd);
    peer_doorbell_.ring(Doorbell::attention_bit);
}

ProcessIdentity Segment::peer_process() const {
    return read_identity(mapping_->fd(), other(side())).value_or(ProcessIdentity{});
}

void Segment::end_sleeps() const { FutexTimeoutThread::of_process().end_sleeps(mapping_->memory()); }

bool Segment::superseded() const {
    // This order matters: a truncated file may have no header to read.
    return mapping_->truncated() || !still_named(mapping_->fd()) ||
           load_word(&mapping_->header().superseded_by) > generation();
}

RingHandle Segment::add_ring(const std::string& name, const RingOptions& options) {
    const RingMemory bytes = ring_memory(name, options);
    return create_ring(mapping_, directory_.add(name, layout::ObjectKind::ring, bytes.total, bytes.idle),
                       options);
}

CallQueueHandle Segment::add_call_queue(const std::string& name, const CallQueueOptions& options) {
    const CallQueueMemory bytes = call_queue_memory(name, options);
    const bool needs_loans = options.max_bytes > layout::short_call_bytes;
    bool& has_loans = has_loans_[index_of(options.callers)];
    if (needs_loans && has_loans)
        throw Error(path() + ": call queue '" + name + "': another queue of these callers has long calls; " +
                    "expected max_bytes up to 64 KiB");
    const auto memory = directory_.add(name, layout::ObjectKind::call_queue, bytes.total, bytes.idle);
    has_loans = has_loans || needs_loans;
    return create_call_queue(mapping_, memory, options);
}

std::span<std::byte> Segment::add_blob(const std::string& name, std::size_t bytes) {
    return directory_.add(name, layout::ObjectKind::blob, bytes, bytes);
}

void Segment::publish() {
    directory_.publish();
    announce_change(mapping_->fd());
    peer_doorbell_.ring(Doorbell::attention_bit);
}

bool Segment::peer_published() const {
    return mapping_->side_header(other(side())).published.load(std::memory_order_acquire) != 0;
}

std::optional<RingHandle> Segment::find_ring(Side owner, const std::string& name) const {
    const auto memory = directory_.find(owner, name, layout::ObjectKind::ring);
    if (!memory) return std::nullopt;
    return open_ring(mapping_, *memory, name);
}

std::optional<CallQueueHandle> Segment::find_call_queue(Side owner, const std::string& name) const {
    const auto memory = directory_.find(owner, name, layout::ObjectKind::call_queue);
    if (!memory) return std::nullopt;
    return open_call_queue(mapping_, *memory, name);
}

std::optional<std::span<std::byte>> Segment::find_blob(Side owner, const std::string& name) const {
    return directory_.find(owner, name, layout::ObjectKind::blob);
}

std::optional<std::vector<std::byte>> Segment::copy_blob(Side owner, const std::string& name) const {
    const auto memory = find_blob(owner, name);
    if (!memory) return std::nullopt;
    // A blob has had memory since it was added, so nothing longer than the memory is a blob.
    if (memory->size() > mapping_->memory_bytes())
        throw Error(path() + ": blob '" + name + "' of side " + name_of(owner) + " claims " +
                    std::to_string(memory->size()) + " bytes, more than the file has; restart that side");
    std::vector<std::byte> copy(memory->size());
    copy_from_shared(copy.data(), memory->data(), copy.size());
    return copy;
}

std::vector<ObjectInfo> Segment::list(Side owner) const { return directory_.list(owner); }

} // namespace tandem::shm
