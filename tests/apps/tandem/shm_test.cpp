// SPDX-License-Identifier: Apache-2.0
#include "program.hpp"

#include "shm/call/call_client.hpp"
#include "shm/call/call_server.hpp"
#include "tests/support/skip.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

using namespace tandem::shm;
using namespace tandem::shm::test;
using namespace tandem::test;

namespace {

/// A host in a separate process that joins one side and writes until it is killed.
Child writing_host(const std::string& link, Side side) {
    Child child([=] {
        const auto segment = Segment::join(link, side, small());
        RingWriter writer(
            segment->add_ring("odometry", {.writer = side, .max_record = 100, .capacity = 4096}));
        segment->add_call_queue("services", {.callers = side, .slots = 4, .max_bytes = 100});
        segment->publish();
        for (;;) {
            writer.write(tandem::shm::test::bytes_of("eight doubles"), now_ns());
            std::this_thread::sleep_for(1ms);
        }
        return 0;
    });
    REQUIRE(eventually([&] {
        const auto seen = shm_program({"stats", link, "--json"});
        return seen.exit_code == 0 && !seen.json()["rings"].empty() && seen.json()["rings"][0]["sent"] > 0;
    }));
    return child;
}

std::string only_file(const Link& link) {
    const auto files = link.files();
    REQUIRE(files.size() == 1);
    return files[0];
}

} // namespace

TEST_CASE("list shows a segment and both of its sides") {
    const Pair pair;
    const auto segment = listed(pair.link.name);
    CHECK(segment["generation"] == 1);
    CHECK(segment["state"] == "readable");
    CHECK(segment["sides"]["first"]["pid"] == getpid());
    CHECK(segment["sides"]["second"]["held"] == true);
    const auto text = shm_program({"list"});
    CHECK(text.exit_code == 0);
    CHECK(text.output_contains(pair.link.name));
    CHECK(text.output_contains("pid " + std::to_string(getpid())));
}

TEST_CASE("list says when a pid belongs to another namespace") {
    const Pair pair;
    const auto place =
        sizeof(tandem::shm::layout::SegmentHeader) + offsetof(tandem::shm::layout::SideHeader, pid_namespace);
    std::fstream(only_file(pair.link), std::ios::binary | std::ios::in | std::ios::out)
        .seekp(static_cast<std::streamoff>(place))
        .write("another", 8);
    const auto side = listed(pair.link.name)["sides"]["first"];
    CHECK(side["state"] == "alive");
    CHECK(side["pid"].is_null());
    CHECK(side["pid_in_other_namespace"] == getpid());
    CHECK(shm_program({"list"}).output_contains("alive, pid " + std::to_string(getpid()) +
                                                " of another namespace"));
}

TEST_CASE("list distinguishes a dead side from one that never joined") {
    const Link link;
    Child host = writing_host(link.name, Side::first);
    CHECK(listed(link.name)["sides"]["second"]["state"] == "absent");
    host.kill_now();
    CHECK(listed(link.name)["sides"]["first"]["state"] == "dead");
}

TEST_CASE("list names damaged segments with the reason and still ends with 0") {
    const Link link;
    SECTION("no segment at all") { std::ofstream(segment_path(link.name, 3)) << "hello"; }
    SECTION("empty") { std::ofstream{segment_path(link.name, 3)}; }
    SECTION("a folder") { std::filesystem::create_directory(segment_path(link.name, 3)); }
    CHECK(listed(link.name)["state"] == "damaged");
    CHECK_FALSE(listed(link.name)["reason"].get<std::string>().empty());
    const auto text = shm_program({"list"});
    CHECK(text.exit_code == 0);
    CHECK(text.output_contains("damaged: "));
    const auto info = shm_program({"info", link.name});
    CHECK(info.exit_code == 1);
    CHECK(info.errors.find("damaged") != std::string::npos);
}

TEST_CASE("a segment of another user is listed and neither read nor removed") {
    if (geteuid() != 0) TANDEM_SKIP("only root can make a segment of another user");
    const Link link;
    const auto path = segment_path(link.name, 1);
    std::ofstream(path) << "secret";
    REQUIRE(chown(path.c_str(), 12345, 12345) == 0);
    CHECK(listed(link.name)["state"] == "foreign");
    CHECK(listed(link.name)["owner"] == "12345");
    CHECK(shm_program({"stats", link.name}).exit_code == 1);
    const auto clean = shm_program({"clean", link.name});
    CHECK(clean.exit_code == 0);
    CHECK(clean.output_contains("kept"));
    CHECK(clean.output_contains("12345"));
    CHECK(std::filesystem::exists(path));
}

TEST_CASE("info shows the objects of both sides") {
    const Pair pair;
    pair.first->add_ring("scan", {.max_record = 1000, .capacity = 4096});
    pair.second->add_ring("stick", {.writer = Side::second, .max_record = 100, .capacity = 4096});
    pair.second->add_call_queue("calls", {.slots = 5, .max_bytes = 100});
    pair.second->add_blob("table", 321);
    pair.first->publish();
    pair.second->publish();
    const auto text = shm_program({"info", pair.link.name});
    CHECK(text.exit_code == 0);
    for (const char* part :
         {"scan", "first writes, 4 KiB", "stick", "second writes,", "calls", "5 slots", "table", "321 B"})
        CHECK(text.output_contains(part));
    const auto json = shm_program({"info", pair.link.name, "--json"}).json();
    REQUIRE(json["objects"].size() == 4);
    CHECK(json["objects"][0]["name"] == "scan");
    CHECK(json["objects"][0]["owner"] == "first");
    CHECK(json["damage"].empty());
}

TEST_CASE("control characters and invalid UTF-8 in names reach neither the terminal nor the JSON") {
    const Pair pair;
    pair.first->add_blob("\x1b[2J\xff\"name", 10);
    pair.first->publish();
    const auto text = shm_program({"info", pair.link.name});
    CHECK(text.output_contains("?[2J?\"name"));
    CHECK(text.output.find('\x1b') == std::string::npos);
    CHECK(shm_program({"info", pair.link.name, "--json"}).json()["objects"].size() == 1);
}

TEST_CASE("stats of a running writer grow, and an idle segment does not change") {
    const Link link;
    Child host = writing_host(link.name, Side::first);
    const auto sent = [&] {
        return shm_program({"stats", link.name, "--json"}).json()["rings"][0]["sent"].get<std::uint64_t>();
    };
    const auto before = sent();
    CHECK(eventually([&] { return sent() > before; }));

    ::kill(host.pid(), SIGSTOP);
    const auto bytes = [&] {
        std::ifstream file(only_file(link), std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    REQUIRE(eventually([&] { return listed(link.name)["sides"]["first"]["state"] == "stopped"; }));
    const auto idle = bytes();
    const auto stats = shm_program({"stats", link.name});
    CHECK(stats.output_contains("odometry"));
    CHECK(stats.output_contains("services"));
    CHECK(stats.output_contains("stopped"));
    shm_program({"list"});
    shm_program({"info", link.name});
    CHECK(bytes() == idle);
}

TEST_CASE("stats shows open calls with their age and progress") {
    const Pair pair;
    CallServer server(pair.second->add_call_queue("services", {.callers = Side::first, .slots = 4}));
    pair.second->publish();
    CallClient client(*pair.first->find_call_queue(Side::second, "services"));
    CHECK_FALSE(shm_program({"stats", pair.link.name}).output_contains("open call"));
    std::thread caller([&] { client.call({}, 300s); });
    auto running = server.take(20s);
    if (running) running->set_progress(0.125);
    const auto text = shm_program({"stats", pair.link.name});
    const auto json = shm_program({"stats", pair.link.name, "--json"}).json()["call_queues"][0]["open_calls"];
    if (running) running->reply(CallStatus::ok);
    caller.join();
    CHECK(text.output_contains("open call"));
    CHECK(text.output_contains("running"));
    CHECK(text.output_contains("12.5 %"));
    REQUIRE(json.size() == 1);
    CHECK(json[0]["state"] == "running");
    CHECK(json[0]["progress"] == 0.125);
    CHECK(json[0]["age_ns"] > 0);
}

TEST_CASE("stats --watch prints one line of JSON per period, with the rates since the previous one") {
    const Link link;
    Child host = writing_host(link.name, Side::second);
    const auto watch = shm_program({"stats", link.name, "--json", "--watch", "0.1", "--count", "3"});
    CHECK(watch.exit_code == 0);
    std::istringstream lines(watch.output);
    std::vector<nlohmann::json> observations;
    for (std::string line; std::getline(lines, line);) observations.push_back(nlohmann::json::parse(line));
    REQUIRE(observations.size() == 3);
    CHECK_FALSE(observations[0].contains("rates"));
    CHECK(observations[2]["rates"]["rings"][0]["name"] == "odometry");
    CHECK(observations[2]["rates"]["rings"][0]["sent_per_s"] > 0.0);
    CHECK(observations[2]["rates"]["call_queues"][0]["calls_per_s"] == 0.0);
    CHECK(shm_program({"stats", link.name, "--watch", "0.05", "--count", "2"}).output_contains("sent/s"));
}

TEST_CASE("stats --watch continues when the segment is gone") {
    const Link link;
    const auto watch = shm_program({"stats", link.name, "--watch", "0.02", "--count", "2"});
    CHECK(watch.exit_code == 0);
    CHECK(watch.output_contains("no segment exists now"));
}

TEST_CASE("clean removes the segments of dead processes and nothing else") {
    const Link dead, living, damaged;
    Child(writing_host(dead.name, Side::first)).kill_now();
    const auto segment = join(living, Side::first);
    std::ofstream{segment_path(damaged.name, 7)} << "damaged";

    const auto living_result = shm_program({"clean", living.name, "--json"});
    CHECK(living_result.json()["removed"].empty());
    CHECK(living_result.json()["kept"].size() == 1);
    CHECK(living.files().size() == 1);

    const auto result = shm_program({"clean", dead.name});
    CHECK(result.exit_code == 0);
    CHECK(result.output_contains("removed"));
    CHECK(result.output_contains("dead, pid"));
    CHECK(dead.files().empty());
    CHECK(damaged.files().size() == 1);
    CHECK(shm_program({"clean", damaged.name}).output_contains("shorter than a header"));
    CHECK(damaged.files().empty());
    CHECK(shm_program({"clean", damaged.name}).output_contains("nothing to remove"));
    CHECK(shm_program({"stats", living.name}).exit_code == 0);
}

TEST_CASE("an error of tandem shm is reported in one line on standard error, with exit code 1") {
    const auto lines = [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); };
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"info", "nosuchlink"},
                                                      {"stats", "no/such"},
                                                      {"clean", "a.b"},
                                                      {"stats", "nosuchlink", "--generation", "3"}}) {
        const auto result = shm_program(arguments);
        CHECK(result.exit_code == 1);
        CHECK(result.output.empty());
        CHECK(lines(result.errors) == 1);
    }
    CHECK(shm_program({"stats"}).exit_code != 0);
    CHECK(tandem_program({}).exit_code != 0);
    CHECK(shm_program({"stats", "x", "--watch", "0"}).exit_code != 0);
    CHECK(shm_program({"stats", "x", "--count", "2"}).exit_code != 0);
}

TEST_CASE("every command of tandem shm has help") {
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"},
                                                      {"list", "--help"},
                                                      {"info", "--help"},
                                                      {"stats", "--help"},
                                                      {"clean", "--help"}}) {
        const auto result = shm_program(arguments);
        CHECK(result.exit_code == 0);
        CHECK(result.output.size() > 200);
    }
}
