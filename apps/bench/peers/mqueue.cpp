// SPDX-License-Identifier: Apache-2.0
// POSIX message queues: through the kernel. Its default limits (10 messages of 8 KiB) exclude large messages.
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/peers/peer_cases.hpp"

#include <cerrno>
#include <fcntl.h>
#include <mqueue.h>
#include <system_error>

namespace tandem::bench {

namespace {

template <std::size_t bytes, Wake wake>
class MqueueEndpoint {
  public:
    explicit MqueueEndpoint(Session& session)
        : out_(open(session, session.is_a() ? "-0" : "-1", O_WRONLY)),
          in_(open(session, session.is_a() ? "-1" : "-0",
                   wake == Wake::spin ? O_RDONLY | O_NONBLOCK : O_RDONLY)) {}
    ~MqueueEndpoint() {
        mq_close(out_);
        mq_close(in_);
    }
    MqueueEndpoint(const MqueueEndpoint&) = delete;
    MqueueEndpoint& operator=(const MqueueEndpoint&) = delete;
    void send(std::uint64_t sequence) {
        message_.write(sequence);
        if (mq_send(out_, static_cast<const char*>(message_.data()), bytes, 0) != 0) fail("mq_send");
    }
    std::uint64_t receive() {
        while (mq_receive(in_, static_cast<char*>(message_.data()), bytes, nullptr) < 0)
            if (errno != EAGAIN) fail("mq_receive");
        return message_.read();
    }

  private:
    [[noreturn]] static void fail(const char* operation) {
        throw std::system_error(errno, std::generic_category(), operation);
    }
    static mqd_t open(Session& session, const char* end, int flags) {
        mq_attr sizes{};
        sizes.mq_maxmsg = 10;
        sizes.mq_msgsize = bytes;
        const mqd_t queue = mq_open(("/" + session.name() + end).c_str(), flags | O_CREAT, 0600, &sizes);
        if (queue < 0) fail("mq_open");
        return queue;
    }
    Message<bytes> message_;
    mqd_t out_, in_;
};

} // namespace

void add_mqueue_cases(Registry& registry) {
    PeerCases cases(registry, "posix-mqueue");
    cases.one_way<MqueueEndpoint<64, Wake::spin>>(Wake::spin);
    cases.one_way<MqueueEndpoint<64, Wake::blocking>>(Wake::blocking);
    cases.call<PairClientOf<MqueueEndpoint<64, Wake::spin>>, PairServerOf<MqueueEndpoint<64, Wake::spin>>>(
        Wake::spin, "pair");
    cases.rate<MqueueEndpoint<64, Wake::blocking>>(Wake::blocking);
}

} // namespace tandem::bench
