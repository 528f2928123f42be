// SPDX-License-Identifier: Apache-2.0
// A consumer whose own thread waits for the link's messages: it is woken by the peer, and no other thread is.
#include "tests/proxy/link/link_side.hpp"

#include "proxy/link/protocol/control.hpp"
#include "tests/support/context_switches.hpp"

#include <fcntl.h>
#include <thread>

using namespace tandem;
using namespace tandem::link;
using namespace tandem::link::test;

namespace {

using Wait = ArrivalNotifier::Wait;

/// A thread that waits for the messages of one side, as the executor of an event-driven component does.
class Consumer {
  public:
    Consumer(Link& link, std::vector<std::string> ports) : link_(link), ports_(std::move(ports)) {
        for (const auto& port : ports_)
            link.set_arrival_listener(
                link.reader(port), [this] { ++told; }, this);
        thread_ = std::thread([this] { run(); });
    }
    ~Consumer() {
        ends_ = true;
        link_.wake_consumer(this);
        thread_.join();
        for (const auto& port : ports_) link_.set_arrival_listener(link_.reader(port), {});
    }
    void wake() { link_.wake_consumer(this); }

    std::atomic<int> arrived{0}, woken{0}, refused{0}; ///< how its waits have ended
    std::atomic<int> told{0};                          ///< by the notifier

  private:
    void run() {
        while (!ends_) {
            const Wait result = link_.wait_for_arrivals(this);
            ++(result == Wait::arrived ? arrived : result == Wait::woken ? woken : refused);
            if (result == Wait::refused) std::this_thread::sleep_for(1ms);
        }
    }
    Link& link_;
    const std::vector<std::string> ports_;
    std::atomic<bool> ends_{false};
    std::thread thread_;
};

PortTable two_ports() {
    return {
        {{"Two0"}},
        {{PortKind::data_out, "left", "T", "d", "", {}}, {PortKind::data_out, "right", "T", "d", "", {}}}};
}

/// A side with consumers, and a peer that rings for what it sends.
struct Scene {
    explicit Scene(const std::string& what) : name(unique_name(what)), side(adaptor(name)) {
        side->link.open();
        start_peer();
    }
    void start_peer() {
        peer = std::make_unique<LinkSide>(shm::Side::second, LinkOptions{name}, two_ports());
        peer->on_call = [this](const Request& request) {
            peer->link.serve_listen(request.arguments);
            return Reply{};
        };
        peer->link.open();
        wait_until_up(*side, *peer);
    }
    void ask_for_rings() {
        REQUIRE(side->link.request_rings({"left", "right"}, soon).status == CallStatus::ok);
    }
    bool send(const std::string& port) { return link::test::send(peer->link.writer(port), 1); }
    /// Sends one message and waits until the count has risen.
    bool is_noticed(const std::string& port, const std::atomic<int>& count) {
        const int before = count;
        return send(port) && eventually([&] { return count > before; });
    }
    /// Waits until the consumer's own thread has noticed a message. Earlier messages may have woken the notifier.
    bool has_turn(Consumer& consumer, const std::string& port = "left") {
        return eventually([&] {
            const int before = consumer.arrived;
            send(port);
            std::this_thread::sleep_for(2ms);
            return consumer.arrived > before;
        });
    }

    /// Takes the turn for a consumer that has no thread, in this thread. A wake-up is pending, so this thread
    /// never waits.
    void take_turn(const void* consumer) {
        do {
            REQUIRE(send("left"));
            side->link.wake_consumer(consumer);
        } while (side->link.wait_for_arrivals(consumer) != Wait::arrived);
    }

    const std::string name;
    std::unique_ptr<LinkSide> side, peer;
};

long switches_of_notifier() {
    long sum = 0;
    for (const auto& [thread, count] : tandem::test::count_context_switches(getpid()))
        if (thread.starts_with("tandem-arrivals")) sum += count;
    return sum;
}

} // namespace

TEST_CASE("a message for a consumer that waits in its own thread wakes this thread and not the notifier") {
    Scene scene("direct");
    Consumer consumer(scene.side->link, {"left", "right"});
    scene.ask_for_rings();
    REQUIRE(scene.has_turn(consumer));
    const long switches = switches_of_notifier();
    const int told = consumer.told;
    for (int i = 0; i < 100; ++i) REQUIRE(scene.is_noticed(i % 2 == 0 ? "left" : "right", consumer.arrived));
    CHECK(switches_of_notifier() <= switches + 1); // it may not have been asleep yet
    CHECK(consumer.told == told);
}

TEST_CASE("a consumer is notified once about messages that arrived while it did not wait") {
    Scene scene("busy");
    scene.side->link.set_arrival_listener(
        scene.side->link.reader("left"), [] {}, &scene);
    scene.ask_for_rings();
    const auto wait = [&] { return scene.side->link.wait_for_arrivals(&scene); };
    scene.take_turn(&scene);
    for (int i = 0; i < 3; ++i) REQUIRE(scene.send("left"));
    CHECK(wait() == Wait::arrived);
    scene.side->link.wake_consumer(&scene);
    CHECK(wait() == Wait::woken);
}

TEST_CASE("wake_consumer ends a consumer's wait, even before the wait begins") {
    Scene scene("woken");
    Consumer consumer(scene.side->link, {"left"});
    scene.ask_for_rings();
    REQUIRE(scene.has_turn(consumer));
    for (int i = 0; i < 100; ++i) {
        const int before = consumer.woken;
        consumer.wake();
        REQUIRE(eventually([&] { return consumer.woken > before; }));
    }
}

TEST_CASE(
    "while several consumers listen the notifier notifies them all, afterwards the one that is left waits "
    "itself") {
    Scene scene("several");
    Consumer first(scene.side->link, {"left"});
    scene.ask_for_rings();
    REQUIRE(scene.has_turn(first));
    {
        std::atomic<int> other{0};
        scene.side->link.set_arrival_listener(scene.side->link.reader("right"), [&] { ++other; });
        scene.ask_for_rings();
        for (int i = 0; i < 20; ++i) {
            REQUIRE(scene.is_noticed("right", other));
            REQUIRE(scene.is_noticed("left", first.told));
        }
        scene.side->link.set_arrival_listener(scene.side->link.reader("right"), {});
    }
    CHECK(scene.has_turn(first));
}

TEST_CASE("the notifier takes over from a consumer that does not return when another one listens") {
    Scene scene("absent");
    Link& link = scene.side->link;
    link.set_arrival_listener(
        link.reader("left"), [] {}, &scene);
    scene.ask_for_rings();
    scene.take_turn(&scene);
    std::atomic<int> other{0};
    link.set_arrival_listener(link.reader("right"), [&] { ++other; });
    scene.ask_for_rings();
    CHECK(scene.is_noticed("right", other));
    CHECK(link.wait_for_arrivals(&scene) == Wait::refused);
}

TEST_CASE("a consumer that waits in its own thread gets the messages of a peer that returned, and waits in "
          "its session") {
    Scene scene("returned");
    Consumer consumer(scene.side->link, {"left"});
    for (int round = 1; round <= 3; ++round) {
        scene.ask_for_rings();
        REQUIRE(scene.has_turn(consumer));
        scene.peer.reset();
        REQUIRE(eventually([&] { return scene.side->downs == round; }));
        REQUIRE(eventually([&] { return scene.side->went == round; }));
        scene.start_peer();
    }
}

TEST_CASE("a consumer leaves a file that is truncated under it and waits in the next one") {
    Scene scene("truncated");
    Consumer consumer(scene.side->link, {"left"});
    scene.ask_for_rings();
    REQUIRE(scene.has_turn(consumer));
    const std::string path = shm::segment_path(scene.name, shm::list_generations(scene.name).at(0));
    SECTION("to nothing") { REQUIRE(truncate(path.c_str(), 0) == 0); }
    SECTION("behind the headers") { REQUIRE(truncate(path.c_str(), shm::layout::arenas_begin) == 0); }
    SECTION("removed") { REQUIRE(unlink(path.c_str()) == 0); }
    REQUIRE(eventually([&] { return scene.side->ups == 2 && scene.side->link.is_up(); }));
    REQUIRE(eventually([&] { return scene.peer->link.is_up(); }));
    scene.ask_for_rings();
    CHECK(scene.has_turn(consumer));
}

TEST_CASE("a link that closes releases a waiting consumer and refuses it from then on") {
    Scene scene("closing");
    Consumer consumer(scene.side->link, {"left"});
    scene.ask_for_rings();
    REQUIRE(scene.has_turn(consumer));
    const int before = consumer.refused;
    scene.side->link.close();
    CHECK(eventually([&] { return consumer.refused > before + 2; }));
}

TEST_CASE("a link with a waiting consumer is idle while no message comes") {
    Scene scene("still");
    Consumer consumer(scene.side->link, {"left"});
    scene.ask_for_rings();
    REQUIRE(scene.has_turn(consumer));
    CHECK(eventually([&] {
        const auto before = tandem::test::count_context_switches(getpid());
        const int waits = consumer.arrived + consumer.woken;
        std::this_thread::sleep_for(1500ms);
        auto after = tandem::test::count_context_switches(getpid());
        std::size_t moved = 0;
        for (const auto& [thread, count] : before) moved += after[thread] != count ? 1 : 0;
        return moved <= 1 && consumer.arrived + consumer.woken == waits; // this thread itself
    }));
}
