// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/observe/followed_port.hpp"
#include "apps/tandem/observe/link_follower.hpp"
#include "apps/tandem/observe/message_idl.hpp"
#include "apps/tandem/observe/message_json.hpp"
#include "followed_link.hpp"

#include <atomic>
#include <nlohmann/json.hpp>
#include <thread>

using namespace tandem;
using namespace tandem::command;
using namespace tandem::test;

namespace {

/// Sends on a thread until the end of the scope.
class Sending {
  public:
    Sending(FollowedLink& link, const std::string& port)
        : thread_([this, &link, port] {
              for (std::uint32_t second = 1; !done_; ++second) {
                  link.send(port, second, second / 2.0);
                  std::this_thread::sleep_for(std::chrono::milliseconds(2));
              }
          }) {}
    ~Sending() {
        done_ = true;
        thread_.join();
    }

  private:
    std::atomic<bool> done_ = false;
    std::thread thread_;
};

/// Returns the bytes that `put` writes, as a message of that signature.
template <class Put>
nlohmann::ordered_json decoded(const std::string& signature, Put&& put) {
    std::vector<std::byte> bytes;
    wire::CdrWriter out(bytes);
    put(out);
    return message_to_json(wire::parse_signature(signature), bytes);
}

std::string idl_of(const std::string& signature, const std::string& type = "IDL:M/T:1.0") {
    FollowedPort port;
    port.port.type = type;
    port.message = wire::parse_signature(signature);
    return message_idl(port).text;
}

} // namespace

TEST_CASE("echo prints messages with the names of their members") {
    FollowedLink link({timed_double_port("temperature"), timed_double_port("pressure")});
    const Sending sending(link, "temperature");
    const auto one = tandem_program({"echo", link.name(), "temperature", "-n", "2"});
    CHECK(one.exit_code == 0);
    CHECK(one.output_contains(R"({"tm":{"sec":)"));
    CHECK(one.output_contains(R"("data":)"));
    CHECK(std::count(one.output.begin(), one.output.end(), '\n') == 2);
    const auto all = tandem_program({"echo", link.name(), "-n", "1"});
    CHECK(all.output.rfind("temperature {", 0) == 0);
    const auto json = tandem_program({"echo", link.name(), "-n", "1", "--json"}).json();
    CHECK(json["port"] == "temperature");
    CHECK(json["link"] == link.name());
    CHECK(json["value"]["data"] == json["value"]["tm"]["sec"].get<double>() / 2);
    CHECK(json["sent"]["sec"] == json["sequence"]); // the sender counts both from 1
}

TEST_CASE("echo reports an error in one line") {
    const FollowedLink link({timed_double_port("temperature")});
    const auto port = tandem_program({"echo", link.name(), "temprature"});
    CHECK(port.exit_code == 1);
    CHECK(port.errors ==
          "tandem: link '" + link.name() + "' has no data port 'temprature'; its data ports: temperature\n");
    CHECK(tandem_program({"echo", "no-such-link"}).exit_code == 1);
    const auto silent = tandem_program({"echo", link.name(), "--timeout", "0.1"});
    CHECK(silent.exit_code == 1);
    CHECK(silent.errors.find("no message for 0.1 s") != std::string::npos);
}

TEST_CASE("hz counts the messages of each port") {
    FollowedLink link({timed_double_port("temperature"), timed_double_port("pressure")});
    const Sending sending(link, "temperature");
    const auto json = tandem_program({"hz", link.name(), "--period", "0.5", "--count", "1", "--json"}).json();
    CHECK(json["ports"][0]["port"] == "pressure");
    CHECK(json["ports"][0]["messages_per_s"] == 0);
    CHECK(json["ports"][1]["messages_per_s"] > 0);
    CHECK(json["ports"][1]["min_ms"] <= json["ports"][1]["mean_ms"]);
    const auto text = tandem_program({"hz", link.name(), "--period", "0.1", "--count", "2"});
    CHECK(text.exit_code == 0);
    CHECK(text.output_contains("messages/s"));
}

TEST_CASE("a link is followed to its next generation") {
    std::vector<std::uint64_t> generations;
    const auto deliver = [&](const LinkFollower::Port& port, const shm::FollowedRecord&) {
        generations.push_back(port.generation);
    };
    auto link = std::make_unique<FollowedLink>(std::vector{timed_double_port("temperature")});
    const std::string name = link->name();
    LinkFollower follower(name, {});
    int changes = 0;
    const auto look = [&] { follower.poll(deliver, [&] { ++changes; }); };
    look();
    link->send("temperature", 1, 1);
    look();
    REQUIRE(generations.size() == 1);
    link.reset();
    link = std::make_unique<FollowedLink>(
        std::vector{timed_double_port("temperature"), timed_double_port("late")}, name);
    link->send("late", 2, 2);
    CHECK(shm::test::eventually([&] {
        look();
        return generations.size() == 2;
    }));
    CHECK(changes == 2);
    CHECK(follower.lost() == 0);
}

TEST_CASE("the models of both sides come from their tables, and a side without ports is a change") {
    FollowedLink link({timed_double_port("temperature")});
    LinkFollower follower(link.name(), {});
    int changes = 0;
    const auto look = [&] {
        follower.poll([](const LinkFollower::Port&, const shm::FollowedRecord&) {}, [&] { ++changes; });
    };
    look();
    CHECK(follower.models() == Models{"OPRoS", ""});
    link.publish_model_of_second("RTM");
    CHECK(shm::test::eventually([&] {
        look();
        return changes == 2;
    }));
    CHECK(follower.models() == Models{"OPRoS", "RTM"});
}

TEST_CASE("a port that gets another type is followed with that type") {
    std::vector<std::string> signatures;
    FollowedLink link({timed_double_port("temperature")});
    LinkFollower follower(link.name(), {});
    int changes = 0;
    const auto look = [&] {
        follower.poll([&](const LinkFollower::Port& port,
                          const shm::FollowedRecord&) { signatures.push_back(port.port.signature); },
                      [&] { ++changes; });
    };
    look();
    link.send("temperature", 1, 1);
    look();
    auto other = timed_double_port("temperature");
    other.signature = "{celsius}d";
    other.ring = 1;
    link.change_port(other);
    CHECK(shm::test::eventually([&] {
        look();
        return changes == 2;
    }));
    link.send("temperature", 2, 2);
    look();
    CHECK(signatures == std::vector<std::string>{"{tm}({sec}u{nsec}u){data}d", "{celsius}d"});
    CHECK(follower.lost() == 0);
}

TEST_CASE("messages of every type are decoded") {
    CHECK(decoded("{flag}b{text}s{list}ai{bytes}ay", [](wire::CdrWriter& out) {
              out.put_bool(true);
              out.put_string("hi");
              for (const int number : {2, -1, 7}) out.put(number);
              out.put(2);
              out.put(std::uint8_t{0x0a});
              out.put(std::uint8_t{0xff});
          }).dump() == R"({"flag":true,"text":"hi","list":[-1,7],"bytes":"0aff"})");
    CHECK(decoded("i(dd)", [](wire::CdrWriter& out) {
              out.put(3);
              out.put(0.5);
              out.put(1.0 / 0.0);
          }).dump() == R"([3,[0.5,"inf"]])");
    const auto label = [](std::int32_t number) {
        return [=](wire::CdrWriter& out) {
            out.put(number);
            if (number == 0)
                out.put(1.5);
            else
                out.put_string("x");
        };
    };
    CHECK(decoded("{u}<i;0=d;*=s>", label(0)).dump() == R"({"u":{"case":0,"value":1.5}})");
    CHECK(decoded("{u}<i;0=d;*=s>", label(9)).dump() == R"({"u":{"case":9,"value":"x"}})");
    CHECK(decoded("{v}v", [](wire::CdrWriter& out) {
              out.put_string("s");
              out.put(6); // bytes of the value
              out.put(2);
              out.put('!');
              out.put('\0');
          }).dump() == R"({"v":{"type":"s","value":"!"}})");
}

TEST_CASE("bytes that are not a message of the type are refused") {
    std::vector<std::byte> bytes(3);
    CHECK_THROWS_AS(message_to_json(wire::parse_signature("{a}i"), bytes), std::runtime_error);
    bytes = std::vector<std::byte>(4, std::byte{0xff}); // a count that nothing follows
    CHECK_THROWS_AS(message_to_json(wire::parse_signature("{a}ad"), bytes), std::runtime_error);
}

TEST_CASE("a type is declared in IDL") {
    CHECK(idl_of("{tm}({sec}u{nsec}u){data}ad", "IDL:RTC/TimedDoubleSeq:1.0") ==
          "module RTC {\nstruct TimedDoubleSeq_tm {\n  unsigned long sec;\n  unsigned long nsec;\n};\n"
          "struct TimedDoubleSeq {\n  TimedDoubleSeq_tm tm;\n  sequence<double> data;\n};\n};\n");
    CHECK(idl_of("is", "std::vector<Pose>") ==
          "struct std__vector_Pose_ {\n  long member_0;\n  string member_1;\n};\n");
    // Keywords, sequences as elements, and types that IDL readers lack.
    CHECK(idl_of("{in}aad{wide}w{kind}e#3{a}[4]c", "T") ==
          "struct T_in {\n  sequence<double> value;\n};\nstruct T {\n  sequence<T_in> _in;\n  "
          "sequence<octet> wide;\n"
          "  unsigned long kind;\n  char a[4];\n};\n");
}
