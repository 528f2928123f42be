// SPDX-License-Identifier: Apache-2.0
// ZeroMQ over ipc: PAIR for messages, REQ/REP for calls. Its I/O thread shares the core of its process.
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/peers/peer_cases.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <zmq.h>

namespace tandem::bench {

namespace {

[[noreturn]] void fail(const char* operation) {
    throw std::runtime_error(fmt::format("{}: {}", operation, zmq_strerror(zmq_errno())));
}

class Socket {
  public:
    Socket(const Session& session, int type) : context_(zmq_ctx_new()), socket_(zmq_socket(context_, type)) {
        const std::string address = "ipc://@" + session.name(); // abstract: no file
        const int linger = 1000;                                // ms, for the last message
        zmq_setsockopt(socket_, ZMQ_LINGER, &linger, sizeof linger);
        if ((session.is_a() ? zmq_connect(socket_, address.c_str()) : zmq_bind(socket_, address.c_str())) !=
            0)
            fail("zmq_connect/zmq_bind");
    }
    ~Socket() {
        zmq_close(socket_);
        zmq_ctx_term(context_);
    }
    Socket(const Socket&) = delete;
    Socket& operator=(const Socket&) = delete;
    void* get() const { return socket_; }

  private:
    void* context_;
    void* socket_;
};

template <std::size_t bytes, Wake wake, int type_a = ZMQ_PAIR, int type_b = ZMQ_PAIR>
class ZmqEndpoint {
  public:
    explicit ZmqEndpoint(Session& session) : socket_(session, session.is_a() ? type_a : type_b) {}
    void send(std::uint64_t sequence) {
        zmq_msg_t message;
        zmq_msg_init_size(&message, bytes);
        fill_message(zmq_msg_data(&message), bytes, sequence);
        if (zmq_msg_send(&message, socket_.get(), 0) < 0) fail("zmq_msg_send");
    }
    std::uint64_t receive() {
        zmq_msg_t message;
        zmq_msg_init(&message);
        while (zmq_msg_recv(&message, socket_.get(), wake == Wake::spin ? ZMQ_DONTWAIT : 0) < 0)
            if (zmq_errno() != EAGAIN) fail("zmq_msg_recv");
        const std::uint64_t sequence = checked_sequence(zmq_msg_data(&message), bytes);
        zmq_msg_close(&message);
        return sequence;
    }

  private:
    Socket socket_;
};

template <Wake wake>
using CallEndpoint = ZmqEndpoint<64, wake, ZMQ_REQ, ZMQ_REP>;

} // namespace

void add_zeromq_cases(Registry& registry) {
    PeerCases cases(registry, "zeromq");
    cases.one_way<ZmqEndpoint<64, Wake::spin>>(Wake::spin);
    cases.one_way<ZmqEndpoint<64, Wake::blocking>>(Wake::blocking);
    cases.call<PairClientOf<CallEndpoint<Wake::blocking>>, PairServerOf<CallEndpoint<Wake::blocking>>>(
        Wake::blocking);
    cases.rate<ZmqEndpoint<64, Wake::blocking>>(Wake::blocking);
    cases.large<ZmqEndpoint<mebibyte, Wake::blocking>>(mebibyte, Wake::blocking, "copy");
    cases.large<ZmqEndpoint<6 * mebibyte, Wake::blocking>>(6 * mebibyte, Wake::blocking, "copy");
}

} // namespace tandem::bench
