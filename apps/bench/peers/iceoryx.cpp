// SPDX-License-Identifier: Apache-2.0
// iceoryx (classic, Debian's version 2): zero-copy publish and subscribe by loan and take, by polling and by
// WaitSet, and its client and server. Its daemon RouDi runs during each case. Publishers wait for a slow
// subscriber, so that no message is lost.
#include "apps/bench/peers/peer_cases.hpp"

#include <chrono>
#include <memory>
#include <thread>

#include <iceoryx_hoofs/log/logmanager.hpp>
#include <iceoryx_posh/popo/untyped_client.hpp>
#include <iceoryx_posh/popo/untyped_publisher.hpp>
#include <iceoryx_posh/popo/untyped_server.hpp>
#include <iceoryx_posh/popo/untyped_subscriber.hpp>
#include <iceoryx_posh/popo/wait_set.hpp>
#include <iceoryx_posh/runtime/posh_runtime.hpp>

namespace tandem::bench {

namespace {

// A payload begins at the start of a cache line.
constexpr std::uint32_t alignment = 64;

/// Call it before any publisher or subscriber is created; registers this side with RouDi.
void start_runtime(const Session& session) {
    iox::log::LogManager::GetLogManager().SetDefaultLogLevel(iox::log::LogLevel::kError,
                                                             iox::log::LogLevelOutput::kHideLogLevel);
    const std::string name = session.name() + (session.is_side_a() ? "-a" : "-b");
    iox::runtime::PoshRuntime::initRuntime({iox::cxx::TruncateToCapacity, name.c_str()});
}

/// Services have the case's name, so that two cases do not see each other's services.
iox::capro::ServiceDescription service(const Session& session, const char* event) {
    return {{iox::cxx::TruncateToCapacity, session.name().c_str()},
            "bench",
            {iox::cxx::TruncateToCapacity, event}};
}

/// Discovery takes a few of RouDi's cycles.
template <class Ready>
void wait_for(Ready&& ready) {
    while (!ready()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

/// Reports errors that end the case; its row shows the text.
[[noreturn]] void fail(const char* operation) {
    throw std::runtime_error(std::string("iceoryx: ") + operation);
}

/// A publisher of one topic and a subscriber of the other; messages are filled and summed in shared memory.
template <std::size_t bytes, Wake wake>
class IceoryxEndpoint {
  public:
    explicit IceoryxEndpoint(Session& session)
        : IceoryxEndpoint((start_runtime(session), session), session.is_side_a() ? "0" : "1",
                          session.is_side_a() ? "1" : "0") {}

    // Zero-copy: the message is written where the subscriber will read it.
    void send(std::uint64_t sequence) {
        publisher_.loan(bytes, alignment)
            .and_then([&](void*& chunk) {
                fill_message(chunk, bytes, sequence);
                publisher_.publish(chunk);
            })
            .or_else([](auto&) { fail("no chunk to loan, see RouDi's pools"); });
    }
    std::uint64_t receive() {
        for (;;) {
            auto taken = subscriber_.take();
            if (!taken.has_error()) {
                const std::uint64_t sequence = checked_sequence(taken.value(), bytes);
                subscriber_.release(taken.value());
                return sequence;
            }
            if (taken.get_error() != iox::popo::ChunkReceiveResult::NO_CHUNK_AVAILABLE) fail("take failed");
            if constexpr (wake == Wake::blocking) wait_set_->wait();
        }
    }

  private:
    // Within RouDi's pools (suite.cpp).
    static constexpr std::uint64_t depth = bytes <= 4096 ? 256 : 4;

    IceoryxEndpoint(Session& session, const char* out, const char* in)
        : publisher_(service(session, out), publisher_options()),
          subscriber_(service(session, in), subscriber_options()) {
        wait_for([&] { return publisher_.hasSubscribers(); });
        wait_for([&] { return subscriber_.getSubscriptionState() == iox::SubscribeState::SUBSCRIBED; });
        if constexpr (wake == Wake::blocking) {
            wait_set_ = std::make_unique<iox::popo::WaitSet<>>();
            wait_set_->attachState(subscriber_, iox::popo::SubscriberState::HAS_DATA).or_else([](auto) {
                fail("cannot attach to the WaitSet");
            });
        }
    }
    // Both options are necessary: the publisher must permit waiting, and the subscriber must request it.
    static iox::popo::PublisherOptions publisher_options() {
        iox::popo::PublisherOptions options;
        options.subscriberTooSlowPolicy = iox::popo::ConsumerTooSlowPolicy::WAIT_FOR_CONSUMER;
        return options;
    }
    static iox::popo::SubscriberOptions subscriber_options() {
        iox::popo::SubscriberOptions options;
        options.queueCapacity = depth;
        options.queueFullPolicy = iox::popo::QueueFullPolicy::BLOCK_PRODUCER;
        return options;
    }

    iox::popo::UntypedPublisher publisher_;
    iox::popo::UntypedSubscriber subscriber_;
    std::unique_ptr<iox::popo::WaitSet<>> wait_set_; // last: it detaches from the subscriber first
};

/// Requests are loaned and sent like messages.
template <Wake wake>
class IceoryxClient {
  public:
    explicit IceoryxClient(Session& session) : client_((start_runtime(session), service(session, "call"))) {
        wait_for([&] { return client_.getConnectionState() == iox::ConnectionState::CONNECTED; });
        if constexpr (wake == Wake::blocking) {
            wait_set_ = std::make_unique<iox::popo::WaitSet<>>();
            wait_set_->attachState(client_, iox::popo::ClientState::HAS_RESPONSE).or_else([](auto) {
                fail("cannot attach to the WaitSet");
            });
        }
    }
    /// Blocking: sleeps in the WaitSet; otherwise takes until there is a response.
    std::uint64_t call(std::uint64_t sequence) {
        auto request = client_.loan(bytes, alignment);
        if (request.has_error()) fail("no chunk for a request");
        fill_message(request.value(), bytes, sequence);
        client_.send(request.value()).or_else([](auto&) { fail("cannot send a request"); });
        for (;;) {
            auto response = client_.take();
            if (!response.has_error()) {
                const std::uint64_t answered = checked_sequence(response.value(), bytes);
                client_.releaseResponse(response.value());
                return answered;
            }
            if constexpr (wake == Wake::blocking) wait_set_->wait();
        }
    }

  private:
    static constexpr std::size_t bytes = 64;
    iox::popo::UntypedClient client_;
    std::unique_ptr<iox::popo::WaitSet<>> wait_set_;
};

/// A reply is loaned for its request: the request identifies its client.
template <Wake wake>
class IceoryxServer {
  public:
    explicit IceoryxServer(Session& session) : server_((start_runtime(session), service(session, "call"))) {
        if constexpr (wake == Wake::blocking) {
            wait_set_ = std::make_unique<iox::popo::WaitSet<>>();
            wait_set_->attachState(server_, iox::popo::ServerState::HAS_REQUEST).or_else([](auto) {
                fail("cannot attach to the WaitSet");
            });
        }
        wait_for([&] { return server_.hasClients(); });
    }
    std::uint64_t serve() {
        for (;;) {
            auto request = server_.take();
            if (request.has_error()) {
                if constexpr (wake == Wake::blocking) wait_set_->wait();
                continue;
            }
            const std::uint64_t sequence = checked_sequence(request.value(), bytes);
            auto response =
                server_.loan(iox::popo::RequestHeader::fromPayload(request.value()), bytes, alignment);
            if (response.has_error()) fail("no chunk for a response");
            fill_message(response.value(), bytes, sequence);
            server_.send(response.value()).or_else([](auto&) { fail("cannot send a response"); });
            server_.releaseRequest(request.value());
            return sequence;
        }
    }

  private:
    static constexpr std::size_t bytes = 64;
    iox::popo::UntypedServer server_;
    std::unique_ptr<iox::popo::WaitSet<>> wait_set_;
};

} // namespace

// Streams by polling only: a WaitSet would sleep and wake for each message.
void add_iceoryx_cases(Registry& registry) {
    PeerCases cases(registry, "iceoryx", "iox-roudi");
    cases.add_one_way<IceoryxEndpoint<64, Wake::spin>>(Wake::spin);
    cases.add_one_way<IceoryxEndpoint<64, Wake::blocking>>(Wake::blocking);
    cases.add_paced<IceoryxEndpoint<64, Wake::spin>>(Wake::spin);
    cases.add_paced<IceoryxEndpoint<64, Wake::blocking>>(Wake::blocking);
    cases.add_call<IceoryxClient<Wake::spin>, IceoryxServer<Wake::spin>>(Wake::spin);
    cases.add_call<IceoryxClient<Wake::blocking>, IceoryxServer<Wake::blocking>>(Wake::blocking);
    cases.add_small_stream<IceoryxEndpoint<64, Wake::spin>>(Wake::spin);
    cases.add_large_stream<IceoryxEndpoint<mebibyte, Wake::spin>>(mebibyte, Wake::spin, "loan");
    cases.add_large_stream<IceoryxEndpoint<6 * mebibyte, Wake::spin>>(6 * mebibyte, Wake::spin, "loan");
}

} // namespace tandem::bench
