// SPDX-License-Identifier: Apache-2.0
// ZeroMQ over ipc (a Unix socket): PAIR sockets for messages, REQ and REP for calls. Its I/O thread runs on
// the core to which its process is pinned, and each message passes through it.
#include "apps/bench/peers/peer_cases.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <zmq.h>

namespace tandem::bench {

namespace {

/// ZeroMQ has separate error numbers in addition to errno.
[[noreturn]] void fail(const char* operation) {
    throw std::runtime_error(fmt::format("{}: {}", operation, zmq_strerror(zmq_errno())));
}

/// A context with one socket: A connects, B binds.
class Socket {
  public:
    Socket(const Session& session, int type) : context_(zmq_ctx_new()), socket_(zmq_socket(context_, type)) {
        const std::string address = "ipc://@" + session.name(); // abstract name: there is no file
        const int linger = 1000; // ms: the last message is still sent when the socket is closed
        zmq_setsockopt(socket_, ZMQ_LINGER, &linger, sizeof linger);
        if ((session.is_side_a() ? zmq_connect(socket_, address.c_str())
                                 : zmq_bind(socket_, address.c_str())) != 0)
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

/// ZeroMQ allocates a message, which is filled in place. Large messages are passed to the I/O thread without
/// a copy.
template <std::size_t bytes, Wake wake, int type_a = ZMQ_PAIR, int type_b = ZMQ_PAIR>
class ZmqEndpoint {
  public:
    explicit ZmqEndpoint(Session& session) : socket_(session, session.is_side_a() ? type_a : type_b) {}
    void send(std::uint64_t sequence) {
        zmq_msg_t message;
        zmq_msg_init_size(&message, bytes);
        fill_message(zmq_msg_data(&message), bytes, sequence);
        if (zmq_msg_send(&message, socket_.get(), 0) < 0) fail("zmq_msg_send");
    }
    // Polling asks repeatedly for a message; blocking sleeps until the I/O thread has one.
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

// REQ and REP alternate sending and receiving, as a call does.
template <Wake wake>
using CallEndpoint = ZmqEndpoint<64, wake, ZMQ_REQ, ZMQ_REP>;

} // namespace

void add_zeromq_cases(Registry& registry) {
    PeerCases cases(registry, "zeromq");
    cases.add_one_way<ZmqEndpoint<64, Wake::spin>>(Wake::spin);
    cases.add_one_way<ZmqEndpoint<64, Wake::blocking>>(Wake::blocking);
    cases.add_call<PairClientOf<CallEndpoint<Wake::blocking>>, PairServerOf<CallEndpoint<Wake::blocking>>>(
        Wake::blocking);
    cases.add_small_stream<ZmqEndpoint<64, Wake::blocking>>(Wake::blocking);
    cases.add_large_stream<ZmqEndpoint<mebibyte, Wake::blocking>>(mebibyte, Wake::blocking, "copy");
    cases.add_large_stream<ZmqEndpoint<6 * mebibyte, Wake::blocking>>(6 * mebibyte, Wake::blocking, "copy");
}

} // namespace tandem::bench
