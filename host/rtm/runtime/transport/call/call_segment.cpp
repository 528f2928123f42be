// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/call/call_segment.hpp"
#include "shm/segment/truncation_guard.hpp"

namespace RTC {
namespace {

using tandem::shm::Segment;
using tandem::shm::Side;

constexpr char queue_name[] = "calls";
constexpr std::uint64_t call_contract =
    0x43414c4c'00000001; // "CALL", and the version of what is in the segment
// Messages of the ORB have the same limit (-ORBgiopMaxMsgSize). Long ones take memory during the call only.
constexpr tandem::shm::CallQueueOptions queue_options{
    .callers = Side::first, .slots = max_shared_calls, .max_bytes = std::size_t{64} << 20};

tandem::shm::JoinOptions call_join_options() {
    tandem::shm::JoinOptions options;
    options.arena_bytes = tandem::shm::call_queue_size(queue_options) + 4096;
    options.sparse = true;
    options.contract = call_contract;
    return options;
}

} // namespace

CallSegment create_call_segment(const std::string& link) {
    std::shared_ptr<Segment> segment = Segment::join(link, Side::first, call_join_options());
    tandem::shm::install_truncation_guard();
    auto calls = segment->add_call_queue(queue_name, queue_options);
    segment->publish();
    return {std::move(segment), std::move(calls)};
}

CallSegment open_call_segment(const std::string& link) {
    if (!link.starts_with(call_link_prefix))
        throw tandem::shm::Error("link '" + link + "': not a name of a segment for calls");
    std::shared_ptr<Segment> segment = Segment::join(link, Side::second, call_join_options());
    tandem::shm::install_truncation_guard();
    auto calls = segment->find_call_queue(Side::first, queue_name);
    // join() creates a missing segment: in another container the link is a different one.
    if (!calls) throw tandem::shm::Error(segment->path() + ": was not made by the caller");
    return {std::move(segment), std::move(*calls)};
}

CORBA::Boolean CallStream::checkInputOverrun(CORBA::ULong item_bytes, CORBA::ULong items,
                                             omni::alignment_t alignment) {
    const auto mask = static_cast<std::size_t>(alignment) - 1;
    const auto begin = (reinterpret_cast<std::size_t>(pd_inb_mkr) + mask) & ~mask;
    return begin + std::size_t{item_bytes} * items <= reinterpret_cast<std::size_t>(pd_inb_end);
}

} // namespace RTC
