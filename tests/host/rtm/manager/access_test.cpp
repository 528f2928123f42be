// SPDX-License-Identifier: Apache-2.0
// What other users of the machine can do to a manager. The attacker is a process of another user, which only root can create.
// Other users skip these cases, with one line.
#include "host/local/local_endpoint.hpp"
#include "host/rtm/runtime/naming/remote_names.hpp"
#include "tests/host/rtm/giop/giop_message.hpp"
#include "tests/host/rtm/manager_fixture.hpp"
#include "tests/host/rtm/remote_host.hpp"
#include "tests/support/skip.hpp"
#include <functional>
#include <rtm/CORBA_RTCUtil.h>
#include <set>
#include <sys/stat.h>
#include <sys/un.h>

using namespace testing;

namespace {

constexpr uid_t nobody = 65534;

std::vector<std::string> without_tcp() {
    return {"-f", "/dev/null",
            "-o", "manager.modules.load_path:" TANDEM_TEST_PLUGINS,
            "-o", "manager.modules.preload:TestComponents.so",
            "-o", "manager.components.precreate:Counter"};
}

// The inodes of the sockets of internet protocols in which this network namespace listens.
std::set<std::string> listening_inodes() {
    std::set<std::string> inodes;
    for (const char* path : {"/proc/net/tcp", "/proc/net/tcp6", "/proc/net/udp", "/proc/net/udp6"}) {
        std::ifstream table(path);
        std::string line;
        std::getline(table, line);
        while (std::getline(table, line)) {
            std::istringstream words(line);
            std::string word, state;
            for (int i = 0; i < 10 && words >> word; ++i)
                if (i == 3) state = word;
            if (state == "0A" || state == "07")
                inodes.insert(word); // TCP_LISTEN; an unconnected socket of UDP
        }
    }
    return inodes;
}

std::size_t open_port_count(pid_t pid) {
    const auto inodes = listening_inodes();
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/" + std::to_string(pid) + "/fd")) {
        const std::string target = std::filesystem::read_symlink(entry).string();
        if (target.compare(0, 8, "socket:[") == 0) count += inodes.count(target.substr(8, target.size() - 9));
    }
    return count;
}

std::filesystem::path socket_of(pid_t pid) {
    for (const auto& endpoint : tandem::local::find_local_endpoints(tandem::local::manager_endpoint))
        if (endpoint.pid == pid) return endpoint.socket;
    return {};
}

// Runs `attack` in a process of another user and returns its result; -1 if there can be none, which is said.
int as_another_user(const std::function<int()>& attack) {
    if (geteuid() != 0) {
        TANDEM_SKIP_PART("only root can start a process of another user");
        return -1;
    }
    const pid_t child = fork();
    if (child == 0) _exit(setgid(nobody) == 0 && setuid(nobody) == 0 ? attack() : 100);
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 101;
}

enum Outcome { refused, answered, no_connection };

// Sends the message and waits for an answer or the end of the connection.
Outcome send_to(const std::string& port, const Bytes& message) {
    const int fd = connect_loopback(port);
    if (fd < 0) return no_connection;
    send_all(fd, message);
    const timeval longest{20, 0};
    setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &longest, sizeof longest);
    char answer[4096];
    const ssize_t n = recv(fd, answer, sizeof answer, 0);
    close(fd);
    return n > 0 ? answered : refused;
}

Bytes two_way(const std::string& key, const std::string& operation, const Call& call) {
    return request(key, operation, call.arguments[0], 2, false);
}

// A request that expects no answer; its sender closes the connection at once.
Bytes one_way(const std::string& key, const std::string& operation) {
    Bytes message = request(key, operation, {}, 2, false);
    message[12 + 4] = 0; // response flags of GIOP 1.2, after the header and the request id
    return message;
}

} // namespace

TEST_CASE(
    "A manager that was asked for no TCP port opens none, and this user's processes can still reach it") {
    HostProcess host(without_tcp());
    REQUIRE(host.wait_for_output("ready\n"));
    CHECK(open_port_count(host.pid()) == 0);
    ManagerFixture fixture;
    CHECK(open_port_count(getpid()) == 0);
    const std::string at = RTC::local_manager_address(host.pid());
    RTM::Manager_var manager = RTC::resolve_manager(fixture.manager().theORB(), at);
    RTC::RTCList_var components = manager->get_components();
    CHECK(components->length() == 1);
    fixture.create<Accumulator>("Accumulator");
    CHECK_NOTHROW(fixture.connect("Accumulator0.in?port=rtcloc://" + at + "/Counter0.out"));
    CHECK(manager->shutdown() == RTC::RTC_OK);
    CHECK(host.wait_for_exit() == 0);
    CHECK(socket_of(host.pid()).empty());
}

TEST_CASE("A manager opens the TCP port that its settings ask for") {
    const std::string port = unused_port();
    const std::string settings = GENERATE_COPY(std::string("corba.endpoints:127.0.0.1:") + port,
                                               std::string("corba.endpoint:127.0.0.1:") + port,
                                               std::string("corba.nameservers:127.0.0.1:9"));
    auto arguments = without_tcp();
    arguments.insert(arguments.end(), {"-o", settings});
    HostProcess host(arguments);
    REQUIRE(host.wait_for_output("ready\n"));
    CHECK(open_port_count(host.pid()) == 1);
    CHECK(host.wait_for_error("open by TCP at "));
}

TEST_CASE("The socket of a manager is in a folder that other users cannot enter") {
    HostProcess host(without_tcp());
    REQUIRE(host.wait_for_output("ready\n"));
    const auto socket = socket_of(host.pid());
    REQUIRE_FALSE(socket.empty());
    struct stat folder {};
    REQUIRE(stat(socket.parent_path().c_str(), &folder) == 0);
    CHECK(folder.st_uid == geteuid());
    CHECK((folder.st_mode & 0777) == 0700);
    const int error = as_another_user([&] {
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        std::strcpy(address.sun_path, socket.c_str());
        const int fd = ::socket(AF_UNIX, SOCK_STREAM, 0);
        return connect(fd, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0 ? 0 : errno;
    });
    CHECK((error == -1 || error == EACCES));
}

TEST_CASE("The socket of a killed manager accepts no connection, even while a helper forked by one of its "
          "components lives") {
    auto arguments = without_tcp();
    arguments.insert(arguments.end(), {"-o", "manager.components.precreate:HelperForker", "-o",
                                       "manager.components.preactivation:HelperForker0"});
    HostProcess host(arguments);
    const std::string text = "helper ";
    REQUIRE(host.wait_for_output(text));
    REQUIRE(host.wait_for_output("\n"));
    const pid_t helper = std::stoi(host.output.substr(host.output.find(text) + text.size()));
    const auto socket = socket_of(host.pid());
    CHECK(tandem::local::accepts_connections(socket));
    host.send_signal(SIGKILL);
    REQUIRE(host.wait_for_exit() == -SIGKILL);
    CHECK_FALSE(tandem::local::accepts_connections(socket));
    CHECK(kill(helper, SIGKILL) == 0); // it has outlived its host
    const auto next = tandem::local::make_local_endpoint(tandem::local::manager_endpoint);
    CHECK(next != socket);
    CHECK_FALSE(std::filesystem::exists(socket)); // the next manager has removed it
}

TEST_CASE("Another user of the machine gets no answer at a TCP port of the manager, and changes nothing") {
    RemoteHost other("Counter", unused_port(), {"manager.components.preactivation:Counter0"});
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture;
    auto* orb = fixture.manager().theORB();
    RTM::Manager_var manager = other.manager(orb);
    RTC::RTObject_var counter = other.component(orb, "Counter0");
    REQUIRE(eventually([&] { return CORBA_RTCUtil::is_in_active(counter.in()); }));
    RTC::ExecutionContextList_var contexts = counter->get_owned_contexts();
    const std::string context = object_key(orb, contexts[CORBA::ULong(0)]),
                      component = object_key(orb, counter.in());
    const std::vector<Bytes> attacks{
        two_way("manager", "load_module", call("", "", "/dev/null", "")),
        two_way("manager", "create_component", call("", "", "Counter")),
        two_way("manager", "set_configuration", call("", "", "manager.modules.load_path", "/tmp")),
        two_way("manager", "get_profile", call("", "")),
        two_way("manager", "shutdown", call("", "")),
        two_way(component, "exit", call("", "")),
        two_way(context, "stop", call("", "")),
        two_way(context, "deactivate_component", call("", "", static_cast<CORBA::Object_ptr>(counter.in()))),
    };
    for (const auto& attack : attacks) {
        const int outcome = as_another_user([&] { return send_to(other.port, attack); });
        CHECK((outcome == -1 || outcome == refused));
    }
    // The kernel no longer knows whose socket it was.
    as_another_user([&] {
        for (int i = 0; i < 200; ++i) {
            const int fd = connect_loopback(other.port);
            send_all(fd, one_way("manager", "shutdown"));
            close(fd);
        }
        return 0;
    });
    CHECK(CORBA_RTCUtil::is_in_active(counter.in()));
    RTC::RTCList_var components = manager->get_components();
    CHECK(components->length() == 1);
    if (geteuid() != 0) return;
    CHECK(other.host.wait_for_error("refused a connection"));
    CHECK(other.host.wait_for_error("(65534)"));
}

TEST_CASE("A user whom corba.permitted_users names is let in, and an unknown one is an error") {
    const std::string port = unused_port();
    RemoteHost other("Counter", port, {"corba.permitted_users:" + std::to_string(nobody)});
    REQUIRE(other.host.wait_for_output("ready\n"));
    const Bytes question = two_way("manager", "get_profile", call("", ""));
    const int outcome = as_another_user([&] { return send_to(port, question); });
    CHECK((outcome == -1 || outcome == answered));
    RemoteHost refusing("Counter", unused_port(), {"corba.permitted_users:no-such-user"});
    CHECK(refusing.host.wait_for_exit() != 0);
    CHECK(refusing.host.errors.find("this machine has no user no-such-user") != std::string::npos);
}

TEST_CASE(
    "A type of component is not a path: create_component() loads nothing from outside the module path") {
    ManagerFixture fixture(false, {"manager.modules.load_path:/nonexistent"});
    const auto known = fixture.manager().getModulesFactories();
    CHECK(fixture.manager().createComponent(TANDEM_TEST_PLUGINS "/TestComponents") == nullptr);
    CHECK(fixture.manager().createComponent("../../../../../../../.." TANDEM_TEST_PLUGINS
                                            "/TestComponents") == nullptr);
    CHECK(fixture.manager().getModulesFactories() == known);
}
