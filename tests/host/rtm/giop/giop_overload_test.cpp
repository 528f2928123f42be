// SPDX-License-Identifier: Apache-2.0
// Peers that occupy the host: messages that keep one of omniORB's threads busy for ever, idle connections, requests that
// stay incomplete. The host keeps few threads and little memory, and serves its other clients. TANDEM_STRESS multiplies
// the connections and messages.
#include "giop_client.hpp"
#include "host/rtm/runtime/network/connection_limits.hpp"
#include "tests/host/rtm/manager_fixture.hpp"
#include "tests/support/stress.hpp"
#include <atomic>
#include <sys/resource.h>
#include <thread>

using namespace testing;

namespace {

constexpr std::size_t most_threads = 64;

Bytes one_way(Bytes two_way, std::size_t flags_at) {
    two_way[flags_at] = 0;
    return two_way;
}

// In GIOP 1.2, the target as a profile of a reference instead of an object key.
Bytes with_profile_as_target() {
    MessageWriter m(true, 2, 0);
    m.number(7); // request id
    m.number(0); // no response
    m.number(1); // target: profile
    m.number(0); // of IIOP
    m.text(std::string("\1\1\0\0\2\0\0\0h\0\1\0\0\0\0\0", 16), false);
    m.text("ping", true);
    m.number(0);
    return m.finish();
}

// A fragment of GIOP 1.2 that is larger than a buffer of omniORB and whose size is not a multiple of 8.
Bytes odd_fragment() {
    MessageWriter m(true, 2, 0);
    m.bytes[6] = 1 | 2; // more fragments
    for (const std::uint32_t number : {7, 0, 0, 20000})
        m.number(number); // id, flags, target: key, its length
    m.bytes.resize(8192 + 1028, 'k');
    return m.finish();
}

// A request whose object key comes in a fragment, and the cancellation of this request instead of the fragment.
Bytes cancelled_fragments() {
    MessageWriter m(true, 2, 0);
    m.bytes[6] = 1 | 2;
    for (const std::uint32_t number : {7, 0, 0, 100}) m.number(number);
    MessageWriter cancel(true, 2, 2);
    cancel.number(7);
    Bytes both = m.finish();
    const Bytes second = cancel.finish();
    both.insert(both.end(), second.begin(), second.end());
    return both;
}

// Its size wraps to 0 when omniORB adds the size of the header.
Bytes message_of_4_gb() {
    Bytes message = request("nobody", "ping", {}, 0, true);
    for (std::size_t i = 0; i < 4; ++i) message[8 + i] = i == 0 ? 0xf4 : 0xff;
    return message;
}

std::vector<Bytes> messages_that_omniorb_cannot_read() {
    const std::string short_key(1, '\0'); // taken for the root POA, but shorter than its keys
    return {one_way(request(short_key, "ping", {}, 0, true), 12 + 8),
            request(short_key, "ping", {}, 0, true),
            one_way(request(short_key, "ping", Bytes(40), 1, true), 12 + 8),
            one_way(request(short_key, "ping", {}, 2, false), 12 + 4),
            with_profile_as_target(),
            odd_fragment(),
            cancelled_fragments(),
            message_of_4_gb()};
}

} // namespace

TEST_CASE("A message that omniORB cannot read ends its connection and leaves no busy thread") {
    RemoteHost other("Counter");
    REQUIRE(other.host.wait_for_output("ready\n"));
    const auto messages = messages_that_omniorb_cannot_read();
    for (std::size_t i = 0; i < messages.size(); ++i) {
        INFO("message " << i);
        Sockets sockets;
        const int fd = sockets.open(other.port);
        REQUIRE(send_all(fd, messages[i]));
        REQUIRE(is_closed_by_host(fd));
    }
    CHECK(other.host.wait_for_error("closed a connection (1 so far) of user "));
    const long before = other.host.cpu_ticks();
    std::this_thread::sleep_for(std::chrono::milliseconds(500)); // a busy thread takes 50 ticks
    CHECK(other.host.cpu_ticks() - before < 20);
    ManagerFixture fixture;
    RTM::Manager_var manager = other.manager(fixture.manager().theORB());
    CHECK_FALSE(manager->is_master());
}

TEST_CASE("Many messages that omniORB cannot read cost neither threads nor memory") {
    RemoteHost other("Counter", unused_port(), {"logger.enable:NO"});
    REQUIRE(other.host.wait_for_output("ready\n"));
    const auto messages = messages_that_omniorb_cannot_read();
    const long count = tandem::test::stress(2000L), memory = other.host.memory_mb();
    std::size_t threads = 0;
    for (long i = 0; i < count; ++i) {
        const int fd = connect_loopback(other.port);
        REQUIRE(fd >= 0);
        send_all(fd, messages[static_cast<std::size_t>(i) % messages.size()]);
        close(fd);
        if (i % 100 == 0) threads = std::max(threads, other.host.thread_count());
    }
    CHECK(threads <= most_threads);
    REQUIRE(other.host.wait_until_idle()); // until it has closed these connections, it may refuse another one
    ManagerFixture fixture;
    RTM::Manager_var manager = other.manager(fixture.manager().theORB());
    CHECK_FALSE(manager->is_master());
    CHECK(other.host.memory_mb() < memory + 60);
}

TEST_CASE("Hundreds of idle connections do not raise the number of threads, and calls continue") {
    RemoteHost other("Counter");
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture;
    RTM::Manager_var manager = other.manager(fixture.manager().theORB());
    REQUIRE_FALSE(manager->is_master());
    const long memory = other.host.memory_mb();
    Sockets sockets;
    for (int i = tandem::test::stress(300, 900); i > 0; --i) sockets.open(other.port);
    CHECK(other.host.wait_for_error("connections of one machine"));
    CHECK(other.host.thread_count() <= most_threads);
    CHECK(other.host.memory_mb() < memory + 60);
    CHECK_FALSE(manager->is_master());
    const int newcomer = sockets.open(other.port);
    REQUIRE(send_all(newcomer, request("manager", "is_master", {}, 2, true)));
    CHECK(gets_reply(newcomer));
    CHECK(other.host.thread_count() <= most_threads);
}

TEST_CASE("Clients occupy a separate thread for each of the first connections, and the shared threads") {
    RemoteHost other("Counter");
    REQUIRE(other.host.wait_for_output("ready\n"));
    Sockets sockets;
    const int client = sockets.open(other.port); // omniORB then also starts another thread
    REQUIRE(send_all(client, request("manager", "is_master", {}, 2, true)));
    REQUIRE(gets_reply(client));
    const std::size_t begin = other.host.thread_count(), separate = begin + RTC::separate_threads - 1,
                      all = separate + RTC::shared_threads;
    for (int i = 1; i < RTC::separate_threads; ++i) sockets.open(other.port);
    CHECK(eventually([&] { return other.host.thread_count() == separate; }));
    for (int i = 0; i < 10; ++i) sockets.open(other.port);
    REQUIRE(other.host.wait_until_idle());
    CHECK(other.host.thread_count() == separate);
    std::size_t most = 0;
    for (int i = 0; i < 120; ++i) {
        REQUIRE(
            send_all(sockets.open(other.port), first_part(request("manager", "is_master", {}, 2, true), 20)));
        most = std::max(most, other.host.thread_count());
    }
    CHECK(most > separate);
    CHECK(most <= all);
}

TEST_CASE("A request that begins before the last fragment of another one ends its connection") {
    RemoteHost other("Counter");
    REQUIRE(other.host.wait_for_output("ready\n"));
    const Bytes long_request = request("nobody", "ping", Bytes(100'000), 2, true);
    Bytes second = request("manager", "is_master", {}, 2, true);
    second[12] = 8; // its id
    Sockets sockets;
    const int fd = sockets.open(other.port);
    REQUIRE(send_all(fd, in_fragments(long_request, 1000, 1000).front()));
    REQUIRE(send_all(fd, second));
    CHECK(is_closed_by_host(fd));
    CHECK(other.host.wait_for_error("before the last fragment of another one"));
}

TEST_CASE("At the limit, the connection that has been idle for longest gives way to a new one") {
    RemoteHost other("Counter", unused_port(), {"corba.max_connections:20"}); // 10 of each machine
    REQUIRE(other.host.wait_for_output("ready\n"));
    const Bytes question = request("manager", "is_master", {}, 2, true);
    Sockets sockets;
    std::vector<int> all;
    const auto use = [&](int fd) {
        REQUIRE(send_all(fd, question));
        REQUIRE(gets_reply(fd));
        char rest[4096];
        recv(fd, rest, sizeof rest, MSG_DONTWAIT);
        // A connection is idle only when its thread has sent the reply and waits again.
        REQUIRE(other.host.wait_until_idle());
    };
    for (int i = 0; i < 10; ++i) {
        all.push_back(sockets.open(other.port));
        use(all.back());
    }
    use(all.front());
    const int newcomer = sockets.open(other.port);
    REQUIRE(send_all(newcomer, question));
    CHECK(gets_reply(newcomer));
    CHECK(next_message_type(all[1]) == 5); // CloseConnection: the client may send its next call again
    CHECK(is_closed_by_host(all[1]));
    use(all.back());
    use(all.front());
    CHECK(other.host.wait_for_error("corba.max_connections"));
}

TEST_CASE("A request that stays incomplete ends its connection, and one without a request stays open") {
    RemoteHost other("Counter", unused_port(), {"corba.request_timeout:0.2"});
    REQUIRE(other.host.wait_for_output("ready\n"));
    const Bytes question = request("manager", "is_master", {}, 2, true);
    const Bytes large = request_with_texts("set_configuration", {"key", std::string(100'000, 'x')});
    Sockets sockets;
    const int idle = sockets.open(other.port);
    for (const Bytes& part : {first_part(question, 20), first_part(question, question.size() - 1),
                              first_part(large, 5000), first_part(large, 90'000)}) {
        const int fd = sockets.open(other.port);
        REQUIRE(send_all(fd, part));
        CHECK(is_closed_by_host(fd));
    }
    CHECK(other.host.wait_for_error("its request was not complete within 0.2 s; corba.request_timeout"));
    REQUIRE(send_all(idle, question));
    CHECK(gets_reply(idle));
}

TEST_CASE("Clients get in while others occupy all shared threads with incomplete requests") {
    const Bytes question = request("manager", "is_master", {}, 2, true);
    for (int round = 0; round < 3; ++round) { // the connections come before the host has made its threads
        RemoteHost other("Counter");
        REQUIRE(other.host.wait_for_output("ready\n"));
        Sockets sockets;
        for (int i = 0; i < 100; ++i) REQUIRE(send_all(sockets.open(other.port), first_part(question, 6)));
        const int newcomer = sockets.open(other.port);
        REQUIRE(send_all(newcomer, question));
        CHECK(gets_reply(newcomer));
    }
}

TEST_CASE("A call that takes longer than corba.request_timeout gets its reply") {
    RemoteHost other("Counter", unused_port(), {"corba.request_timeout:0.2"});
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture;
    RTM::Manager_var manager = other.manager(fixture.manager().theORB());
    // Long enough that it does not arrive at once, so it gets a deadline.
    const std::string text(100'000, 'x');
    RTC::RTObject_var slow = manager->create_component(
        ("SlowDevice?instance_name=Slow&in=initialize&ms=1000&text=" + text).c_str());
    CHECK_FALSE(CORBA::is_nil(slow.in()));
}

TEST_CASE("Large requests that stay incomplete share the memory of one") {
    RemoteHost other(
        "Counter", unused_port(),
        {"corba.request_timeout:2", "corba.args:-ORBgiopMaxMsgSize 8388608", "logger.enable:NO"});
    REQUIRE(other.host.wait_for_output("ready\n"));
    const Bytes large = request_with_texts("set_configuration", {"key", std::string(8'000'000, 'x')});
    const long memory = other.host.memory_mb();
    std::vector<std::thread> clients;
    for (int i = tandem::test::stress(12, 40); i > 0; --i)
        clients.emplace_back([&other, &large] {
            const int fd = connect_loopback(other.port);
            send_all(fd, first_part(large, large.size() - 1000));
            is_closed_by_host(fd);
            close(fd);
        });
    for (auto& client : clients) client.join();
    CHECK(other.host.memory_mb(true) < memory + 50); // without a limit: 8 MB for each
    const int fd = connect_loopback(other.port);
    REQUIRE(send_all(fd, large));
    CHECK(gets_reply(fd));
    close(fd);
}

TEST_CASE("Forty clients that send large messages at the same time are all served") {
    RemoteHost other("Counter", unused_port(), {"logger.enable:NO"});
    REQUIRE(other.host.wait_for_output("ready\n"));
    const Bytes large = request_with_texts("set_configuration", {"key", std::string(6'000'000, 'x')});
    std::atomic<int> served{0};
    std::vector<std::thread> clients;
    for (int i = 0; i < 40; ++i)
        clients.emplace_back([&] {
            const int fd = connect_loopback(other.port);
            const timeval longest{30, 0};
            setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &longest, sizeof longest);
            setsockopt(fd, SOL_SOCKET, SO_SNDTIMEO, &longest, sizeof longest);
            for (int n = 0; n < 3; ++n)
                if (send_all(fd, large) && gets_reply(fd)) {
                    char rest[4096];
                    recv(fd, rest, sizeof rest, MSG_DONTWAIT);
                    ++served;
                }
            close(fd);
        });
    for (auto& client : clients) client.join();
    CHECK(served == 120);
    CHECK(other.host.thread_count() <= most_threads);
}
