// SPDX-License-Identifier: Apache-2.0
// Clients that are slow, and calls that take long: other clients are served meanwhile. Most hosts here have few shared
// threads and no others, as a host with many connections has.
#include "giop_client.hpp"
#include "tests/support/stress.hpp"

using namespace testing;

namespace {

std::string shared_threads_only(int count, const std::string& more = "") {
    return "corba.args:-ORBthreadPerConnectionPolicy 0 -ORBmaxServerThreadPoolSize " + std::to_string(count) +
           more;
}

const Bytes question = request("manager", "is_master", {}, 2, true);

// Returns whether a new client is served soon. The host refuses new clients while its threads are in calls.
bool serves_newcomers(const std::string& port) {
    for (int i = 0; i < 200; ++i) {
        Sockets sockets;
        const int fd = sockets.open(port);
        if (send_all(fd, question) && gets_reply(fd)) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
}

} // namespace

TEST_CASE("A connection whose request is arriving does not give way to a new one") {
    RemoteHost other("Counter", unused_port(), {"corba.max_connections:4"}); // 2 of each machine
    REQUIRE(other.host.wait_for_output("ready\n"));
    Sockets sockets;
    const int slow = sockets.open(other.port);
    const Bytes large = request_with_texts("get_components_by_name", {std::string(6000, 'x')});
    REQUIRE(send_all(slow, first_part(large, 5000)));
    REQUIRE(eventually([&] { return has_read_all(slow, other.port); }));
    const int idle = sockets.open(other.port);
    REQUIRE(send_all(idle, question));
    REQUIRE(gets_reply(idle));
    CHECK(serves_newcomers(other.port)); // `idle` is idle once its thread has left it, soon after the reply
    CHECK(is_closed_by_host(idle));
    REQUIRE(send_all(slow, last_part(large, 5000)));
    CHECK(gets_reply(slow));
}

TEST_CASE("Connections that wait for a thread that closes them are bounded") {
    RemoteHost other("Counter", unused_port(), {"corba.max_connections:20", shared_threads_only(2)});
    REQUIRE(other.host.wait_for_output("ready\n"));
    Sockets sockets;
    for (const char* name : {"One", "Two"}) {
        const int fd = sockets.open(other.port);
        REQUIRE(send_all(fd, slow_call(name, 3000, 10)));
        REQUIRE(eventually([&] { return has_read_all(fd, other.port); }));
    }
    const std::size_t before = other.host.descriptor_count();
    for (int i = tandem::test::stress(300, 900); i > 0; --i) sockets.open(other.port);
    CHECK(other.host.wait_for_error("corba.max_connections"));
    CHECK(other.host.descriptor_count() < before + 100);
    CHECK(serves_newcomers(other.port));
}

TEST_CASE("A host ends cleanly while connections wait for a thread that closes them") {
    setenv("MALLOC_PERTURB_", "90", 1); // what uses freed memory crashes
    RemoteHost other("Counter", unused_port(), {"corba.max_connections:20", shared_threads_only(2)});
    unsetenv("MALLOC_PERTURB_");
    REQUIRE(other.host.wait_for_output("ready\n"));
    Sockets sockets;
    const Bytes large = request_with_texts("get_components_by_name", {std::string(6000, 'x')});
    for (int i = 0; i < 2; ++i) {
        const int fd = sockets.open(other.port);
        REQUIRE(send_all(fd, first_part(large, 5000)));
        REQUIRE(eventually([&] { return has_read_all(fd, other.port); }));
    }
    const std::size_t before = other.host.descriptor_count();
    for (int i = 0; i < 60; ++i) sockets.open(other.port);
    REQUIRE(eventually([&] { return other.host.descriptor_count() >= before + 50; }));
    other.host.send_signal(SIGTERM);
    CHECK(other.host.wait_for_exit() == 0);
}

TEST_CASE("A long call with a large request does not hold up the large requests of other clients") {
    RemoteHost other("Counter", unused_port(), {"corba.args:-ORBgiopMaxMsgSize 8388608", "logger.enable:NO"});
    REQUIRE(other.host.wait_for_output("ready\n"));
    Sockets sockets;
    const int slow = sockets.open(other.port), quick = sockets.open(other.port);
    REQUIRE(send_all(slow, slow_call("Slow", 20'000, 6'000'000)));
    REQUIRE(eventually([&] { return has_read_all(slow, other.port); }));
    REQUIRE(send_all(quick, request_with_texts("get_components_by_name", {std::string(6'000'000, 'x')})));
    CHECK(gets_reply(quick));
}

TEST_CASE("A client that does not read a large reply loses its shared thread to others") {
    RemoteHost other("Counter", unused_port(), {"corba.request_timeout:0.5", shared_threads_only(2)});
    REQUIRE(other.host.wait_for_output("ready\n"));
    Sockets sockets;
    const int owner = sockets.open(other.port);
    REQUIRE(send_all(owner, request_with_texts("set_configuration", {"key", std::string(16'000'000, 'x')})));
    REQUIRE(gets_reply(owner));
    for (int i = 0; i < 2; ++i)
        REQUIRE(send_all(sockets.open(other.port), request("manager", "get_configuration", {}, 2, true)));
    CHECK(other.host.wait_for_error("it did not read the reply within 0.5 s; corba.request_timeout"));
    CHECK(serves_newcomers(other.port));
}

TEST_CASE("Threads in long calls do not shorten the time for the requests of other clients") {
    RemoteHost other("Counter", unused_port(), {shared_threads_only(32)});
    REQUIRE(other.host.wait_for_output("ready\n"));
    Sockets sockets;
    for (int i = 0; i < 28; ++i) {
        const int fd = sockets.open(other.port);
        REQUIRE(send_all(fd, slow_call("Slow" + std::to_string(i), 5000, 20'000))); // larger than a buffer
        REQUIRE(eventually([&] { return has_read_all(fd, other.port); }));
    }
    const int fd = sockets.open(other.port);
    REQUIRE(send_all(fd, first_part(question, 6)));
    std::this_thread::sleep_for(std::chrono::milliseconds(500)); // ten times the short wait
    REQUIRE(send_all(fd, last_part(question, 6)));
    CHECK(gets_reply(fd));
}

TEST_CASE("A client that cancels a request that does not exist keeps no shared thread") {
    RemoteHost other("Counter", unused_port(), {"corba.request_timeout:0.5", shared_threads_only(2)});
    REQUIRE(other.host.wait_for_output("ready\n"));
    MessageWriter cancel(true, 2, 2);
    cancel.number(99);
    Sockets sockets;
    std::vector<int> silent{sockets.open(other.port), sockets.open(other.port)};
    for (const int fd : silent) REQUIRE(send_all(fd, cancel.finish()));
    CHECK(serves_newcomers(other.port));
    for (const int fd : silent) CHECK(is_closed_by_host(fd));
}
