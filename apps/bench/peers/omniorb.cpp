// SPDX-License-Identifier: Apache-2.0
// omniORB, the base of OpenRTM-aist's ports between processes: oneway and twoway operations over TCP on the
// loopback interface and over Unix sockets. A message arrives in a thread of the ORB, which sends the echo
// itself, because a hand-over to another thread would not be a cost of omniORB. Oneways of one connection
// keep their order only with one server thread per connection.
#include "apps/bench/peers/peer_cases.hpp"

#include "omniorb.hh"

#include <condition_variable>
#include <cstdio>
#include <cstring>
#include <deque>
#include <mutex>

namespace tandem::bench {

namespace {

enum class Transport { tcp, unix_socket };

/// [any-thread] The sequence numbers of the messages that have arrived, in order. push() blocks while there
/// are 1024. This stops the ORB's thread. The full socket then stops the sender.
class Inbox {
  public:
    void push(std::uint64_t sequence) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return waiting_.size() < 1024; });
        waiting_.push_back(sequence);
        changed_.notify_all();
    }
    std::uint64_t pop() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return !waiting_.empty(); });
        const std::uint64_t first = waiting_.front();
        waiting_.pop_front();
        changed_.notify_all();
        return first;
    }

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::uint64_t> waiting_;
};

/// [ORB's thread] The object that the other side calls.
class PeerServant : public POA_TandemBench::Peer {
  public:
    PeerServant(Inbox& inbox, bool echoes) : inbox_(inbox), echoes_(echoes) {}
    void put(const TandemBench::Bytes& message) override {
        const std::uint64_t sequence = checked_sequence(message.get_buffer(), message.length());
        if (echoes_) peer->put(message);
        // The main thread of the echoing side only waits for the stop message.
        if (!echoes_ || sequence == stop_sequence) inbox_.push(sequence);
    }
    TandemBench::Bytes* call(const TandemBench::Bytes& message) override {
        inbox_.push(checked_sequence(message.get_buffer(), message.length()));
        return new TandemBench::Bytes(message);
    }
    TandemBench::Peer_var peer;

  private:
    Inbox& inbox_;
    bool echoes_;
};

/// An ORB with one activated object, and a reference to the peer's object. The references are exchanged as
/// text in the session's memory, which replaces a naming service.
template <Transport transport>
class OrbSide {
  public:
    explicit OrbSide(Session& session)
        : orb_(start_orb(session)), echoes_(!session.is_side_a() && is_echoed(session.bench_case())),
          servant_(new PeerServant(inbox_, echoes_)) {
        const CORBA::Object_var root = orb_->resolve_initial_references("RootPOA");
        const PortableServer::POA_var poa = PortableServer::POA::_narrow(root);
        const PortableServer::ObjectId_var id = poa->activate_object(servant_.in());
        // From here on, requests are served.
        const PortableServer::POAManager_var manager = poa->the_POAManager();
        manager->activate();
        const CORBA::Object_var own = poa->id_to_reference(id);
        const CORBA::String_var text = orb_->object_to_string(own);
        char* shared = reinterpret_cast<char*>(session.memory().data());
        std::snprintf(shared + (session.is_side_a() ? 0 : text_bytes), text_bytes, "%s", text.in());
        session.arrive_and_wait();
        const CORBA::Object_var other =
            orb_->string_to_object(shared + (session.is_side_a() ? text_bytes : 0));
        peer_ = TandemBench::Peer::_narrow(other);
        servant_->peer = TandemBench::Peer::_duplicate(peer_);
        session.arrive_and_wait();
    }
    ~OrbSide() {
        peer_ = TandemBench::Peer::_nil();
        servant_->peer = TandemBench::Peer::_nil();
        orb_->destroy();
    }
    OrbSide(const OrbSide&) = delete;
    OrbSide& operator=(const OrbSide&) = delete;

  protected:
    // Two object references, one after the other, at the front of the session's memory.
    static constexpr std::size_t text_bytes = 4096;
    /// Calls and streams are not echoed.
    static bool is_echoed(const Case& bench_case) {
        return bench_case.operation == "one-way" || bench_case.operation == "paired";
    }
    /// Returns the ORB's options: large messages are allowed, and the client uses the measured transport.
    static CORBA::ORB_ptr start_orb(const Session& session) {
        const std::string path = "giop:unix:/tmp/" + session.name() + (session.is_side_a() ? "-a" : "-b");
        const char* options[][2] = {
            {"endPoint", transport == Transport::tcp ? "giop:tcp:127.0.0.1:" : path.c_str()},
            {"clientTransportRule", transport == Transport::tcp ? "* tcp" : "* unix"},
            {"maxServerThreadPerConnection", "1"},
            {"giopMaxMsgSize", "16777216"},
            {nullptr, nullptr}};
        int argc = 0;
        return CORBA::ORB_init(argc, nullptr, "omniORB4", options);
    }
    Inbox inbox_;
    CORBA::ORB_var orb_;
    bool echoes_;
    PortableServer::Servant_var<PeerServant> servant_;
    TandemBench::Peer_var peer_;
};

/// Messages as oneway operations: send() returns when the ORB has written the request to the socket.
template <std::size_t bytes, Transport transport>
class OnewayEndpoint : OrbSide<transport> {
  public:
    explicit OnewayEndpoint(Session& session) : OrbSide<transport>(session) { message_.length(bytes); }
    void send(std::uint64_t sequence) {
        if (this->echoes_) return; // the ORB's thread has sent the echo already
        fill_message(message_.get_buffer(), bytes, sequence);
        this->peer_->put(message_);
    }
    std::uint64_t receive() { return this->inbox_.pop(); }

  private:
    TandemBench::Bytes message_;
};

/// Calls as twoway operations.
template <Transport transport>
class TwowayClient : OrbSide<transport> {
  public:
    explicit TwowayClient(Session& session) : OrbSide<transport>(session) { message_.length(bytes); }
    std::uint64_t call(std::uint64_t sequence) {
        fill_message(message_.get_buffer(), bytes, sequence);
        const TandemBench::Bytes_var reply = this->peer_->call(message_);
        return checked_sequence(reply->get_buffer(), bytes);
    }

  private:
    static constexpr std::size_t bytes = 64;
    TandemBench::Bytes message_;
};

template <Transport transport>
class TwowayServer : OrbSide<transport> {
  public:
    using OrbSide<transport>::OrbSide;
    TwowayServer(Session& session) : OrbSide<transport>(session) {}
    /// The ORB's thread has already answered; this waits for the next sequence number.
    std::uint64_t serve() { return this->inbox_.pop(); }
};

template <Transport transport>
void add_transport(Registry& registry, const char* subject) {
    PeerCases cases(registry, subject);
    cases.add_one_way<OnewayEndpoint<64, transport>>(Wake::blocking);
    cases.add_call<TwowayClient<transport>, TwowayServer<transport>>(Wake::blocking);
    cases.add_small_stream<OnewayEndpoint<64, transport>>(Wake::blocking);
    cases.add_large_stream<OnewayEndpoint<mebibyte, transport>>(mebibyte, Wake::blocking, "copy");
    cases.add_large_stream<OnewayEndpoint<6 * mebibyte, transport>>(6 * mebibyte, Wake::blocking, "copy");
}

} // namespace

void add_omniorb_cases(Registry& registry) {
    add_transport<Transport::tcp>(registry, "omniorb-tcp");
    add_transport<Transport::unix_socket>(registry, "omniorb-unix");
}

} // namespace tandem::bench
