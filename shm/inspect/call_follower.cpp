// SPDX-License-Identifier: Apache-2.0
#include "shm/inspect/call_follower.hpp"

#include "shm/inspect/read_only_snapshot.hpp"
#include "shm/os/shared_copy.hpp"

#include <algorithm>
#include <cstring>

namespace tandem::shm {
namespace {

using layout::CallReply;
using layout::CallRequest;
using layout::CallSlot;
using layout::CallState;

constexpr std::uint64_t head_bytes = sizeof(layout::CallQueueHeader) + sizeof(layout::CallTimes);
constexpr std::size_t reply_at = offsetof(CallSlot, reply);

std::uint64_t word_of(std::span<const std::byte> slot, std::size_t at) {
    std::uint64_t word = 0;
    std::memcpy(&word, slot.data() + at, sizeof word);
    return word;
}

std::span<const std::byte> bytes_of(const std::vector<std::uint64_t>& words, std::size_t bytes) {
    return std::as_bytes(std::span(words)).first(bytes);
}

} // namespace

struct CallFollower::Ended {
    std::uint32_t slot;
    std::uint64_t argument_bytes, result_bytes;
    FollowedCall call;
};

CallFollower::CallFollower(std::shared_ptr<const ReadOnlySnapshot> file, const ObservedCallQueue& queue)
    : file_(std::move(file)), callers_(queue.callers), slots_begin_(queue.file_offset + head_bytes),
      overflow_begin_(slots_begin_ + queue.slots * sizeof(CallSlot)),
      overflow_bytes_(queue.slots == 0 ? 0 : (queue.bytes - head_bytes) / queue.slots - sizeof(CallSlot)),
      max_bytes_(queue.max_bytes), slots_(queue.slots), damaged_(!queue.damage.empty()) {
    bytes_.resize(slots_.size() * sizeof(CallSlot));
}

void CallFollower::poll(const Deliver& deliver, CallActivity activity) {
    if (damaged_) return;
    damaged_ = !file_->read(slots_begin_, bytes_);
    std::vector<Ended> ended;
    for (std::uint32_t index = 0; index < slots_.size() && !damaged_; ++index)
        look_at(index, activity, ended);
    looked_ = true;
    std::sort(ended.begin(), ended.end(),
              [](const Ended& a, const Ended& b) { return a.call.submitted_ns < b.call.submitted_ns; });
    for (Ended& each : ended) {
        const Slot& slot = slots_[each.slot];
        each.call.arguments = bytes_of(slot.arguments, each.argument_bytes);
        each.call.results = bytes_of(slot.results, each.result_bytes);
        ++delivered_;
        deliver(each.call);
    }
}

void CallFollower::look_at(std::uint32_t index, CallActivity activity, std::vector<Ended>& ended) {
    Slot& slot = slots_[index];
    const auto seen = std::span<const std::byte>(bytes_).subspan(index * sizeof(CallSlot), sizeof(CallSlot));
    const std::uint64_t number = word_of(seen, offsetof(CallRequest, calls));
    if (!looked_ && number != 0) slot.delivered = number - 1; // earlier calls do not count as lost
    if (number == slot.delivered) return;
    const std::uint64_t request = word_of(seen, offsetof(CallRequest, word));
    const std::uint64_t reply = word_of(seen, reply_at + offsetof(CallReply, word));
    const bool replied = sequence_of(request) == sequence_of(reply) && !has_state(request, CallState::none);
    const bool given_up =
        has_state(request, CallState::cancelled) || has_state(request, CallState::forgotten);
    const std::uint64_t argument_bytes = length_of(request), result_bytes = replied ? length_of(reply) : 0;
    if (argument_bytes > max_bytes_ || result_bytes > max_bytes_) return; // torn, or not written by a caller
    const auto arguments = seen.subspan(offsetof(CallRequest, arguments), CallView::argument_room);
    // A loan ends with its call, before anybody could copy it.
    const bool by_loan = std::max(argument_bytes, result_bytes) > layout::short_call_bytes;
    if (!replied && !given_up) {
        if (by_loan || slot.copied == number || !copy(index, arguments, argument_bytes, slot.arguments))
            return;
        // The call was still open after the copy, so nobody else has written there.
        const std::uint64_t base = slots_begin_ + index * sizeof(CallSlot);
        const auto request_now = file_->read_word(base), reply_now = file_->read_word(base + reply_at);
        if (request_now && reply_now && sequence_of(*request_now) == sequence_of(request) &&
            sequence_of(*reply_now) != sequence_of(request))
            slot.copied = number;
        return;
    }
    // Long results overwrite the rest of long arguments.
    const bool arguments_gone =
        argument_bytes > CallView::argument_room && result_bytes > CallView::result_room;
    const bool has_arguments = slot.copied == number;
    if (by_loan || (!has_arguments && arguments_gone)) {
        lost_ += number - slot.delivered;
        slot.delivered = number;
        return;
    }
    const bool same = slot.pending == number && std::equal(seen.begin(), seen.end(), slot.looked.begin());
    if (!same) {
        if (!has_arguments && !copy(index, arguments, argument_bytes, slot.arguments)) return;
        if (!copy(index, seen.subspan(reply_at + offsetof(CallReply, results), CallView::result_room),
                  result_bytes, slot.results))
            return;
        slot.pending = number;
        slot.looked.assign(seen.begin(), seen.end());
        if (activity != CallActivity::none) return;
    }
    lost_ += number - slot.delivered - 1;
    slot.delivered = number;
    const auto status = static_cast<CallStatus>(tag_of(reply));
    const bool answered = replied && !given_up && status <= CallStatus::cancelled;
    ended.push_back({index,
                     argument_bytes,
                     answered ? result_bytes : 0,
                     {{},
                      {},
                      word_of(seen, offsetof(CallRequest, submitted_ns)),
                      answered ? status : CallStatus::cancelled,
                      answered}});
}

/// Returns false if no process can have stored this number of bytes in the file. Arguments and results of a call share a buffer, so
/// all copies together are at most twice as long as the memory of the file.
bool CallFollower::make_room(std::vector<std::uint64_t>& memory, std::uint64_t bytes) {
    const std::uint64_t words = round_up(bytes, word_bytes) / word_bytes, before = memory.size();
    if (words > before && held_ + (words - before) * word_bytes > 2 * file_->memory_bytes()) return false;
    held_ += words * word_bytes;
    held_ -= before * word_bytes;
    memory.resize(words);
    return true;
}

/// Copies a payload: the part in the slot, and the rest from the slot's overflow buffer.
bool CallFollower::copy(std::uint32_t index, std::span<const std::byte> in_slot, std::size_t bytes,
                        std::vector<std::uint64_t>& to) {
    if (bytes > in_slot.size() + overflow_bytes_ || !make_room(to, bytes)) return false;
    const auto out = std::as_writable_bytes(std::span(to));
    const std::size_t here = std::min(bytes, in_slot.size());
    std::copy_n(in_slot.begin(), here, out.begin());
    if (bytes == here) return true;
    damaged_ = !file_->read(overflow_begin_ + index * overflow_bytes_, out.subspan(here, bytes - here));
    return !damaged_;
}

} // namespace tandem::shm
