// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/link.hpp"

#include "host/call/thread_calls.hpp"
#include "host/log/log.hpp"
#include "host/process/start_thread.hpp"
#include "proxy/link/protocol/call_limits.hpp"
#include "proxy/link/protocol/control.hpp"
#include "shm/segment/segment_file.hpp"
#include "shm/segment/truncation_guard.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tandem::link {
namespace {

constexpr std::chrono::milliseconds longest_wait_step{100}; // wait_until_up() calls gives_up after each step

/// Returns why a peer that runs may not be visible: it belongs to another user. Empty if there is no file of one.
std::string hint_at_other_user(const LinkOptions& options) {
    const auto access = shm::access_of_this_process(options.group);
    for (const std::uint64_t generation : shm::list_generations(options.name)) {
        const auto path = shm::segment_path(options.name, generation);
        if (shm::probe_segment(path, access).foreign)
            return path +
                   " belongs to another user; run both hosts as one user, or set `group` on both sides";
    }
    return "";
}

/// The memory for a reply of the call queue.
class BufferMemory final : public shm::ResultMemory {
  public:
    explicit BufferMemory(wire::MessageBuffer& buffer) : buffer_(buffer) {}
    std::span<std::byte> room_for(std::size_t bytes) override { return buffer_.room_for(bytes); }

  private:
    wire::MessageBuffer& buffer_;
};

/// Makes the sender thread call with the given handle.
struct HandleOfThread {
    explicit HandleOfThread(const call::SharedHandle* handle) { call::exchange_handle_of_thread(handle); }
    ~HandleOfThread() { call::exchange_handle_of_thread(nullptr); }
    HandleOfThread(const HandleOfThread&) = delete;
    HandleOfThread& operator=(const HandleOfThread&) = delete;
};

/// A call without a waiting caller, from sending to its end. It keeps the handle of the thread that sent it.
class PendingCall {
  public:
    PendingCall() {
        if (const auto* handle = call::handle_of_thread()) handle_ = *handle;
        if (handle_) ++handle_->pending;
    }
    ~PendingCall() {
        if (handle_) --handle_->pending;
    }
    PendingCall(const PendingCall&) = delete;
    PendingCall& operator=(const PendingCall&) = delete;

    /// Makes the call. [the sender's thread]
    template <class Call>
    Reply make(Call&& call) const {
        if (!handle_) return call();
        if (handle_->cancelled) return {CallStatus::cancelled, {}};
        const HandleOfThread scope(&handle_);
        return call();
    }

  private:
    call::SharedHandle handle_; ///< may be null
};

/// Names the bound in the failure if its CallHandle bounded the call. Returns any other failure unchanged.
ReplyView name_bound_of_handle(const ReplyView& timed_out, std::chrono::milliseconds timeout,
                               wire::MessageBuffer& memory) {
    const auto* handle = call::handle_of_thread();
    if (!handle || (*handle)->max_ns == 0 || !timed_out.bytes.empty()) return timed_out;
    return copy_to(memory,
                   Reply::failure(CallStatus::timeout,
                                  fmt::format("no reply within {} ms, the bound of its CallHandle, or "
                                              "not begun within {} ms",
                                              (*handle)->max_ns / 1'000'000, timeout.count())));
}

} // namespace

Link::Link(shm::Side side, LinkOptions options, PortTable own_ports, LinkHandler& handler)
    : options_(std::move(options)), channels_([this] { supervisor_.wake(); }), tasks_(options_.name),
      sends_(options_.name, max_waiting_sends, max_waiting_send_bytes),
      supervisor_(side, options_, std::move(own_ports), handler, state_, channels_, tasks_),
      workers_(options_, state_, handler, [this] { supervisor_.wake(); }), arrivals_(state_, options_.wait) {}

Link::~Link() { close(); }

void Link::open() {
    shm::install_truncation_guard();
    supervisor_.start();
    tasks_.start();
    workers_.start();
}

void Link::close() {
    if (!state_.start_closing()) return;
    // The supervisor stops first: it ends the session, and with it every call that a task or a worker waits for.
    supervisor_.stop();
    tasks_.stop();
    sends_.stop();
    workers_.stop();
    arrivals_.stop();
}

void Link::wait_until_up(std::chrono::milliseconds timeout, const std::string& peer_name,
                         const std::function<bool()>& gives_up) {
    const auto deadline = std::chrono::steady_clock::now() + timeout;
    do {
        const auto result = state_.wait_until_up(std::min(timeout, longest_wait_step));
        if (result.up) return;
        if (!result.refusal.empty()) throw LinkError(result.refusal);
        if (gives_up())
            throw LinkError(fmt::format("link '{}': {} had not joined when this host was asked to stop",
                                        options_.name, peer_name));
    } while (!state_.is_closing() && std::chrono::steady_clock::now() < deadline);
    const auto other_user = hint_at_other_user(options_);
    throw LinkError(fmt::format("link '{}': {} did not join within {} s; {}", options_.name, peer_name,
                                static_cast<double>(timeout.count()) / 1000.0,
                                other_user.empty()
                                    ? fmt::format("start it with link={}, or allow more time", options_.name)
                                    : other_user));
}

Reply Link::call(const Request& request, std::chrono::milliseconds timeout) {
    wire::MessageBuffer buffer;
    wire::CdrWriter encoded(buffer);
    encode(request, encoded);
    wire::MessageBuffer memory;
    return call(encoded.written(), timeout, memory).copy();
}

ReplyView Link::call(std::span<const std::byte> encoded_request, std::chrono::milliseconds timeout,
                     wire::MessageBuffer& memory) {
    const auto session = state_.connected_session(); // keeps the segment mapped during the call
    if (!session)
        return copy_to(memory, Reply::failure(CallStatus::not_ready, "not ready: the peer is not connected"));
    BufferMemory results(memory);
    const auto reply = session->outgoing_calls()->call_into(encoded_request, timeout, results);
    if (reply.status == CallStatus::timeout) [[unlikely]]
        return name_bound_of_handle({reply.status, reply.bytes}, timeout, memory);
    return {reply.status, reply.bytes};
}

Reply Link::request_rings(const std::vector<std::string>& ports, std::chrono::milliseconds timeout) {
    const auto session = state_.connected_session();
    auto reply = call({"", control::listen, "", control::encode(ports)}, timeout);
    arrivals_.set_peer_rings(session, reply.status == CallStatus::ok);
    return reply;
}

Reply Link::send(const Request& request, std::chrono::milliseconds timeout) {
    if (!state_.is_up()) return Reply::failure(CallStatus::not_ready, "not ready: the peer is not connected");
    try {
        sends_.start();
    } catch (const process::NotStarted& error) {
        return Reply::failure(CallStatus::overload, error.what());
    }
    // The request refers to the caller's memory.
    const bool accepted = sends_.post_in_turn(
        timeout, request.arguments.size(),
        [this, timeout, handle = std::make_shared<const PendingCall>(), port = std::string(request.port),
         operation = std::string(request.operation), signature = std::string(request.signature),
         arguments = std::vector<std::byte>(request.arguments.begin(), request.arguments.end())] {
            const auto reply = handle->make([&] {
                return call({port, operation, signature, arguments}, timeout);
            });
            if (reply.status == CallStatus::cancelled) return;
            if (reply.status != CallStatus::ok && failed_sends_.should_log())
                log::warn("link '{}': call of '{}.{}' without a reply failed: {} ({} so far)", options_.name,
                          port, operation, shm::name_of(reply.status), failed_sends_.count());
        });
    if (accepted) return {};
    return Reply::failure(
        CallStatus::overload,
        fmt::format("found no place among {} waiting calls without a reply, or {} bytes, within {} ms",
                    max_waiting_sends, max_waiting_send_bytes, timeout.count()));
}

} // namespace tandem::link
