// SPDX-License-Identifier: Apache-2.0
// POSIX message queues (mq_overview(7)): a copy into the kernel and a copy out of it. The default limits of
// 10 messages of 8 KiB exclude large messages.
#include "apps/bench/peers/peer_cases.hpp"

#include <cerrno>
#include <fcntl.h>
#include <mqueue.h>
#include <system_error>

namespace tandem::bench {

namespace {

/// A queue in each direction, named after the case; the runner unlinks them (remove_leftovers()).
template <std::size_t bytes, Wake wake>
class MqueueEndpoint {
  public:
    explicit MqueueEndpoint(Session& session)
        : out_(open(session, session.is_side_a() ? "-0" : "-1", O_WRONLY)),
          in_(open(session, session.is_side_a() ? "-1" : "-0",
                   wake == Wake::spin ? O_RDONLY | O_NONBLOCK : O_RDONLY)) {}
    ~MqueueEndpoint() {
        mq_close(out_);
        mq_close(in_);
    }
    MqueueEndpoint(const MqueueEndpoint&) = delete;
    MqueueEndpoint& operator=(const MqueueEndpoint&) = delete;
    void send(std::uint64_t sequence) {
        message_.fill(sequence);
        if (mq_send(out_, static_cast<const char*>(message_.data()), bytes, 0) != 0) fail("mq_send");
    }
    std::uint64_t receive() {
        // Without O_NONBLOCK the call sleeps; with it, it returns EAGAIN and the loop polls the kernel.
        while (mq_receive(in_, static_cast<char*>(message_.data()), bytes, nullptr) < 0)
            if (errno != EAGAIN) fail("mq_receive");
        return message_.checked_sequence();
    }

  private:
    [[noreturn]] static void fail(const char* operation) {
        throw std::system_error(errno, std::generic_category(), operation);
    }
    static mqd_t open(Session& session, const char* end, int flags) {
        mq_attr sizes{};
        sizes.mq_maxmsg = 10; // a larger number needs a privilege
        sizes.mq_msgsize = bytes;
        const mqd_t queue = mq_open(("/" + session.name() + end).c_str(), flags | O_CREAT, 0600, &sizes);
        if (queue < 0) fail("mq_open");
        return queue;
    }
    Message<bytes> message_;
    mqd_t out_, in_;
};

} // namespace

// Blocking streams: a full queue blocks the writer in the kernel, an empty one the reader.
void add_mqueue_cases(Registry& registry) {
    PeerCases cases(registry, "posix-mqueue");
    cases.add_one_way<MqueueEndpoint<64, Wake::spin>>(Wake::spin);
    cases.add_one_way<MqueueEndpoint<64, Wake::blocking>>(Wake::blocking);
    cases
        .add_call<PairClientOf<MqueueEndpoint<64, Wake::spin>>, PairServerOf<MqueueEndpoint<64, Wake::spin>>>(
            Wake::spin, "pair");
    cases.add_small_stream<MqueueEndpoint<64, Wake::blocking>>(Wake::blocking);
}

} // namespace tandem::bench
