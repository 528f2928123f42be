// SPDX-License-Identifier: Apache-2.0
// Who may control, and what a request may be. browser/drive_test.mjs drives.
#include "http_client.hpp"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

using namespace tandem::monitor::test;
using namespace tandem::shm::test;

namespace {

const std::string upgrade = "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                            "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";

/// A client at /api/control that has shown its token.
struct Controller : Live {
    explicit Controller(const RunningMonitor& monitor) : Live(monitor, 0, "/api/control") {
        CHECK(ask({{"token", monitor.token}})["ok"] == true);
    }
    nlohmann::json ask(const nlohmann::json& request) {
        send(request.dump());
        return next();
    }
};

/// The child process of a process; 0: there is none.
pid_t find_child(pid_t parent) {
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
        std::ifstream status(entry.path() / "status");
        for (std::string line; std::getline(status, line);)
            if (line == "PPid:\t" + std::to_string(parent)) return std::stoi(entry.path().filename());
    }
    return 0;
}

} // namespace

TEST_CASE("without --control the monitor is read-only") {
    const Pair pair;
    const RunningMonitor monitor(pair.link.name);
    CHECK(monitor.token.empty());
    CHECK(get(monitor, "/api/control", "GET", upgrade + "Origin: http://" + monitor.host() + "\r\n").status ==
          403);
    CHECK(state(monitor)["control"]["allowed"] == false);
}

TEST_CASE("pages of other hosts cannot control, even with the token") {
    const Pair pair;
    const RunningMonitor monitor(pair.link.name, "--control");
    for (const char* origin : {"", "Origin: http://example.org\r\n", "Origin: null\r\n"})
        CHECK(get(monitor, "/api/control", "GET", upgrade + origin).status == 403);
    CHECK(get(monitor, "/api/control").status == 426);
    CHECK(Controller(monitor).ask({{"op", "?"}})["ok"] == false);
}

TEST_CASE("a client with a wrong token is disconnected, and its requests are not carried out") {
    const Pair pair;
    RunningMonitor monitor(pair.link.name, "--control");
    REQUIRE(monitor.token.size() == 32);
    const std::string wrong[] = {R"({"token":""})",
                                 R"({"token":")" + monitor.token.substr(1) + R"("})",
                                 R"({"token":")" + monitor.token + R"(0"})",
                                 R"({"token":")" + std::string(32, '0') + R"("})",
                                 R"({"token":17})",
                                 R"({"op":"rtm","command":"list"})",
                                 "nonsense"};
    for (const auto& hello : wrong) {
        INFO(hello);
        Live client(monitor, 0, "/api/control");
        client.send(hello);
        CHECK_THROWS(client.next());
    }
    CHECK(state(monitor)["control"]["recording"] == "");
    CHECK(get(monitor, "/api/state").body.find(monitor.token) == std::string::npos);
    CHECK(monitor.runs());
}

TEST_CASE("two monitors have two tokens") {
    const Pair pair;
    CHECK(RunningMonitor(pair.link.name, "--control").token !=
          RunningMonitor(pair.link.name, "--control").token);
}

TEST_CASE(
    "malformed requests and arguments that look like options are refused, and the next request is answered") {
    const Pair pair;
    RunningMonitor monitor(pair.link.name, "--control");
    Controller client(monitor);
    const nlohmann::json refused[] = {
        {{"op", "exit"}},
        {{"op", "rtm"}},
        {{"op", 5}},
        {{"op", "rtm"}, {"command", "exit"}, {"arguments", {"A0"}}},
        {{"op", "rtm"}, {"command", "activate"}, {"arguments", {"--help"}}},
        {{"op", "rtm"}, {"command", "activate"}, {"arguments", nlohmann::json::array()}},
        {{"op", "rtm"}, {"command", "activate"}, {"arguments", {std::string(400, 'a')}}},
        {{"op", "rtm"}, {"command", "conf"}, {"arguments", {"A0", "x=\n"}}},
        {{"op", "rtm"}, {"command", "activate"}, {"arguments", "A0"}},
        {{"op", "record"}, {"on", true}, {"links", {"-o"}}},
        {{"op", "drive"}, {"link", pair.link.name}, {"x", 0}, {"y", 900}},
        {{"op", "drive"}, {"link", "?"}, {"x", "left"}, {"y", 900}},
        nlohmann::json::array(),
    };
    for (auto request : refused) {
        if (request.is_object()) request["id"] = 5; // by which the client knows what was refused
        INFO(request.dump());
        const auto reply = client.ask(request);
        CHECK(reply["ok"] == false);
        if (request.is_object()) CHECK(reply["id"] == 5);
    }
    const auto answered =
        client.ask({{"op", "rtm"}, {"id", 7}, {"command", "activate"}, {"arguments", {"NoSuchComponent0"}}});
    CHECK(answered["id"] == 7);
    CHECK(answered["ok"] == false);
    CHECK_THAT(answered["text"].get<std::string>(), Catch::Contains("NoSuchComponent0"));
    // Longer than a request may be: the monitor closes the connection, perhaps before all has been sent.
    CHECK_THROWS((client.send(std::string(20'000, 'x')), client.next()));
    CHECK(monitor.runs());
}

TEST_CASE("too deeply nested JSON from a Foxglove client with the token is refused, and the next request is "
          "answered") {
    const Pair pair;
    RunningMonitor monitor(pair.link.name, "--control");
    Live client(monitor, 0, "/?token=" + monitor.token, "foxglove.websocket.v1");
    CHECK(client.next()["capabilities"].size() == 5);
    const auto answer = [&](const std::string& request) {
        client.send(request);
        for (auto message = client.next();; message = client.next())
            if (message["op"] == "status" || message["op"] == "parameterValues") return message.dump();
    };
    const std::string deep(100'000, '['), end(100'000, ']');
    CHECK_THAT(
        answer(R"({"op":"setParameters","parameters":[{"name":"/a/b/c","value":)" + deep + end + "}]}"),
        Catch::Contains("64 levels"));
    CHECK_THAT(answer(deep), Catch::Contains("64 levels"));
    CHECK_THAT(answer("{"), Catch::Contains("expected JSON"));
    CHECK_THAT(answer(R"({"op":"advertise","channels":5})"), Catch::Contains("expected "));
    CHECK_THAT(answer(R"({"op":"setParameters","parameters":[{"name":"/a/b/c","value":1}]})"),
               Catch::Contains("unknown component of a link"));
    CHECK_THAT(answer(R"({"op":"getParameters","parameterNames":[],"id":"7"})"),
               Catch::Contains(R"("parameters":[])"));
    CHECK(monitor.runs());
}

TEST_CASE("a recording of a link that does not exist is refused") {
    const Pair pair;
    RunningMonitor monitor(pair.link.name, "--control");
    Controller client(monitor);
    const auto reply =
        client.ask({{"op", "record"}, {"on", true}, {"links", {pair.link.name, "no-such-link"}}});
    CHECK(reply["ok"] == false);
    CHECK(reply["text"] == "link 'no-such-link' does not exist; tandem shm list shows existing links");
    CHECK(state(monitor)["control"]["recording"] == "");
}

TEST_CASE("a recording that the page has started and that is killed is in the verdict") {
    const Pair pair;
    pair.first->publish();
    pair.second->publish();
    RunningMonitor monitor(pair.link.name, "--control");
    Controller client(monitor);
    const auto reply = client.ask({{"op", "record"}, {"on", true}, {"links", {pair.link.name}}});
    REQUIRE(reply["ok"] == true);
    const auto recorder = find_child(monitor.pid());
    REQUIRE(recorder > 0);
    kill(recorder, SIGKILL);
    CHECK(eventually([&] { return state(monitor)["verdict"]["level"] == "unrecorded"; }));
    CHECK_THAT(state(monitor)["verdict"]["reason"].get<std::string>(),
               Catch::Contains("tandem record has failed"));
    std::filesystem::remove(reply["text"].get<std::string>());
}
