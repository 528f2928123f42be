// SPDX-License-Identifier: Apache-2.0
// A client that sends broken GIOP to a host's endpoint: the host answers its good clients all the time.
// TANDEM_STRESS=100 makes it 10^6 messages.
#include "giop_message.hpp"
#include "other_host.hpp"
#include <catch2/catch.hpp>
#include <coil/stringutil.h>
#include <cstdlib>
#include <random>
#include <rtm/CORBA_RTCUtil.h>

using namespace testing;

namespace {

void append(Bytes& to, std::uint32_t number) {
    while (to.size() % 4 != 0) to.push_back(0);
    for (int i = 0; i < 4; ++i) to.push_back(static_cast<unsigned char>(number >> (8 * i)));
}

void append(Bytes& to, const std::string& text, bool with_end) {
    append(to, static_cast<std::uint32_t>(text.size() + (with_end ? 1 : 0)));
    to.insert(to.end(), text.begin(), text.end());
    if (with_end) to.push_back(0);
}

// A sound request of GIOP 1.2, little-endian, with an argument of `body` bytes.
Bytes request(const std::string& key, const std::string& operation, const Bytes& body, unsigned minor) {
    Bytes m{'G', 'I', 'O', 'P', 1, static_cast<unsigned char>(minor), 1, 0, 0, 0, 0, 0};
    if (minor < 2) append(m, 0); // no service contexts
    append(m, 7);                // request id
    m.insert(m.end(), {3, 0, 0, 0});
    if (minor == 2) append(m, 0); // target: object key
    append(m, key, false);
    append(m, operation, true);
    append(m, 0); // service contexts, or no principal
    if (!body.empty())
        while (m.size() % 8 != 0) m.push_back(0);
    m.insert(m.end(), body.begin(), body.end());
    const auto size = static_cast<std::uint32_t>(m.size() - 12);
    std::memcpy(&m[8], &size, 4);
    return m;
}

class Mutator {
  public:
    Bytes next(const Bytes& sound) {
        Bytes m = sound;
        switch (pick(6)) {
        case 0: // some bytes
            for (std::size_t i = 0, n = 1 + pick(8); i < n; ++i) m[pick(m.size())] = byte();
            break;
        case 1: // cut off
            m.resize(pick(m.size()));
            break;
        case 2: // a length that is not so
            write(m, 8,
                  pick(2) == 0 ? static_cast<std::uint32_t>(random_())
                               : static_cast<std::uint32_t>(pick(64)));
            break;
        case 3: // a number within
            write(m, 12 + 4 * pick((m.size() - 12) / 4),
                  pick(2) == 0 ? 0xffffffffu : static_cast<std::uint32_t>(random_()));
            break;
        case 4: // more than there should be
            for (std::size_t i = 0, n = pick(64); i < n; ++i) m.push_back(byte());
            break;
        default: // nothing but noise after the header
            for (std::size_t i = 12; i < m.size(); ++i) m[i] = byte();
        }
        return m;
    }
    std::size_t pick(std::size_t below) { return random_() % below; }

  private:
    unsigned char byte() { return static_cast<unsigned char>(random_()); }
    static void write(Bytes& m, std::size_t at, std::uint32_t value) {
        if (at + 4 <= m.size()) std::memcpy(&m[at], &value, 4);
    }
    std::mt19937 random_{20261121};
};

} // namespace

TEST_CASE("A host outlives broken GIOP messages and serves its good clients meanwhile") {
    const char* stress = std::getenv("TANDEM_STRESS");
    const long messages = 10000L * (stress ? std::max(1, std::atoi(stress)) : 1);
    OtherHost other("Counter,Teller", free_port(),
                    {"manager.components.preconnect:Counter0.out?port=Teller0.in",
                     "manager.components.preactivation:Counter0,Teller0"});
    REQUIRE(other.host.says("ready\n"));
    coil::Argv argv(coil::vstring{"test", "-ORBclientCallTimeOutPeriod", "10000", "-ORBtraceLevel", "0"});
    int argc = static_cast<int>(argv.size());
    CORBA::ORB_var orb = CORBA::ORB_init(argc, argv.get(), "omniORB4");
    RTM::Manager_var manager = other.manager(orb.in());
    RTC::RTObject_var counter = other.component(orb.in(), "Counter0");
    const Bytes argument(64, 0x11);
    const std::vector<Bytes> sound{request("manager", "get_components", {}, 2),
                                   request("manager", "get_components_by_name", argument, 2),
                                   request("manager", "set_configuration", argument, 1),
                                   request("manager", "get_profile", {}, 0),
                                   request("NameService", "_is_a", argument, 2)};
    Mutator mutator;
    int fd = -1;
    for (long sent = 0; sent < messages; ++sent) {
        if (fd < 0) fd = connected(other.port);
        REQUIRE(fd >= 0);
        const Bytes m = mutator.next(sound[mutator.pick(sound.size())]);
        const bool taken = send(fd, m.data(), m.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(m.size());
        char answer[4096];
        while (recv(fd, answer, sizeof answer, MSG_DONTWAIT) > 0) continue;
        if (!taken || mutator.pick(4) == 0) { // the host has hung up, or this client does
            close(fd);
            fd = -1;
        }
        if (sent % 1000 != 0) continue;
        RTC::RTCList_var components = manager->get_components();
        REQUIRE(components->length() == 2);
        REQUIRE(CORBA_RTCUtil::is_in_active(counter.in()));
    }
    if (fd >= 0) close(fd);
    RTC::RTCList_var components = manager->get_components();
    CHECK(components->length() == 2);
    other.host.send(SIGTERM);
    CHECK(other.host.wait() == 0);
    orb->destroy();
}
