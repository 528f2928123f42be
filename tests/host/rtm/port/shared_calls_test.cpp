// SPDX-License-Identifier: Apache-2.0
// Service calls between two processes of a machine through shared memory.
#include "tests/host/rtm/manager_fixture.hpp"
#include "tests/host/rtm/remote_host.hpp"
#include "tests/host/rtm/talker.hpp"
#include <algorithm>
#include <atomic>
#include <filesystem>
#include <omniORB4/minorCode.h>
#include <omniORB4/omniInterceptors.h>
#include <rtm/CORBA_RTCUtil.h>
#include <thread>

using namespace testing;

namespace {

std::atomic<int> requests{0};
CORBA::Boolean count_request(omni::omniInterceptors::clientSendRequest_T::info_T&) {
    ++requests;
    return true;
}

/// Counts the requests that this process sends by the ORB from now on.
class OrbRequests {
  public:
    OrbRequests() {
        static const bool added = [] {
            omniORB::getInterceptors()->clientSendRequest.add(count_request);
            return true;
        }();
        static_cast<void>(added);
    }
    int count() const { return requests - before_; }

  private:
    const int before_ = requests;
};

/// A client here and an active provider in another process, connected. The manager does not look for dead peers, which
/// would count as requests.
struct Conversation {
    explicit Conversation(std::vector<std::string> settings = {})
        : fixture(true, with(std::move(settings), "manager.peer_check_interval:3600")) {
        REQUIRE(other.host.wait_for_output("ready\n"));
        register_component_type<TalkClient>(fixture.manager(), "TalkClient");
        client = &fixture.create<TalkClient>("TalkClient");
        there = other.component(fixture.manager().theORB(), "Talker0");
        connect(); // also works before the provider is active
        REQUIRE(CORBA_RTCUtil::activate(there.in()) == RTC::RTC_OK);
        REQUIRE(eventually([&] { return talk().repeat_is("ready"); }));
    }
    void connect() {
        const RTC::RTObject_var here = client->getObjRef();
        REQUIRE(CORBA_RTCUtil::connect_by_name("talk", coil::Properties(), here.in(), "talk", there.in(),
                                               "talk") == RTC::RTC_OK);
    }
    struct Caller {
        Testing::Talk_ptr object;
        Testing::Talk_ptr operator->() const { return object; }
        bool repeat_is(const char* text) const {
            try {
                return std::string(CORBA::String_var(object->repeat(text)).in()) == text;
            } catch (const CORBA::OBJECT_NOT_EXIST&) { // not active yet
                return false;
            }
        }
    };
    static std::vector<std::string> with(std::vector<std::string> settings, const char* setting) {
        settings.emplace_back(setting);
        return settings;
    }
    Caller talk() const { return {client->talk_._ptr()}; }

    RemoteHost other{"Talker"};
    ManagerFixture fixture;
    TalkClient* client = nullptr;
    RTC::RTObject_var there;
};

/// Returns whether all segments for calls have lost their names. Those of a test that runs at the same time soon do.
bool no_file_remains() {
    return eventually([] {
        std::size_t count = 0;
        for (const auto& file : std::filesystem::directory_iterator("/dev/shm"))
            count += file.path().filename().string().find("rtm-calls-") != std::string::npos ? 1 : 0;
        return count == 0;
    });
}

Testing::Bytes bytes_of(CORBA::ULong length) {
    Testing::Bytes bytes;
    bytes.length(length);
    for (CORBA::ULong i = 0; i < length; ++i) bytes[i] = static_cast<CORBA::Octet>(i % 251);
    return bytes;
}

bool is_equal(const Testing::Bytes& a, const Testing::Bytes& b) {
    return a.length() == b.length() &&
           std::equal(a.get_buffer(), a.get_buffer() + a.length(), b.get_buffer());
}

struct Nested : POA_Testing::Listener {
    explicit Nested(Testing::Talk_ptr talk) : talk_(talk) {}
    CORBA::Long heard(CORBA::Long depth) override {
        const Testing::Listener_var self = _this();
        return talk_->call_back(self.in(), depth - 1) + 1;
    }
    Testing::Talk_ptr talk_;
};

/// Makes a call itself while it answers, once it is allowed to.
struct LateCaller : POA_Testing::Listener {
    explicit LateCaller(Testing::Talk_ptr talk) : talk_(talk) {}
    CORBA::Long heard(CORBA::Long) override {
        may_call_.wait(false);
        const CORBA::String_var answer(talk_->repeat("within"));
        has_answer_ = std::string(answer.in()) == "within";
        return 0;
    }
    Testing::Talk_ptr talk_;
    std::atomic<bool> may_call_{false}, has_answer_{false};
};

} // namespace

TEST_CASE("A service call between two processes goes through shared memory, whatever types it has") {
    const Conversation conversation;
    const auto talk = conversation.talk();
    const OrbRequests by_orb;
    for (int i = 0; i < 100; ++i) CHECK(talk.repeat_is("hello"));
    const CORBA::WString_var wide(talk->repeat_wide(L"wide \u00e9 \u3042"));
    CHECK(std::wstring(wide.in()) == L"wide \u00e9 \u3042");
    CORBA::Any value;
    value <<= CORBA::Long(5);
    const CORBA::Any_var any(talk->repeat_any(value));
    CORBA::Long number = 0;
    CHECK((any.in() >>= number));
    CHECK(number == 5);
    for (const CORBA::ULong length : {0U, 1000U, 100'000U, 10'000'000U}) {
        const Testing::Bytes sent = bytes_of(length);
        const Testing::Bytes_var received(talk->repeat_bytes(sent));
        CHECK(is_equal(sent, received.in()));
    }
    const CORBA::Object_var object(talk->repeat_object(talk.object));
    CHECK_FALSE(CORBA::is_nil(object.in()));
    CHECK(talk->_is_a("IDL:Testing/Talk:1.0"));
    CHECK_FALSE(talk->_is_a("IDL:Testing/Calculator:1.0"));
    CHECK_FALSE(talk->_non_existent());
    CHECK(by_orb.count() == 0);
    CHECK(no_file_remains());
}

TEST_CASE("A service call through shared memory ends with the exceptions of a call by the ORB") {
    const Conversation conversation;
    const auto talk = conversation.talk();
    const OrbRequests by_orb;
    try {
        talk->refuse("no time");
        FAIL("no exception");
    } catch (const Testing::Refused& refused) {
        CHECK(std::string(refused.reason.in()) == "no time");
        CHECK(refused.code == 7);
    }
    try {
        talk->fail_with_system_exception();
        FAIL("no exception");
    } catch (const CORBA::BAD_INV_ORDER& error) {
        CHECK(error.minor() == 42);
        CHECK(error.completed() == CORBA::COMPLETED_YES);
    }
    CHECK_THROWS_AS(talk->refuse_wide(0x3042), Testing::WideRefused);
    CHECK_THROWS_AS(talk->refuse_wide(0x1f600),
                    CORBA::BAD_PARAM); // CORBA's wstrings have 16 bits per character
    CHECK_THROWS_AS(talk->fail_undeclared(), CORBA::UNKNOWN);
    CHECK_THROWS_AS(talk->fail_with_other_exception(), CORBA::UNKNOWN);
    CHECK(by_orb.count() == 0);
    CHECK(CORBA_RTCUtil::deactivate(conversation.there.in()) == RTC::RTC_OK);
    CHECK_THROWS_AS(talk->repeat("x"), CORBA::OBJECT_NOT_EXIST);
}

TEST_CASE(
    "Oneway calls through shared memory do not wait, and run in order before the next call of their thread") {
    const Conversation conversation;
    const auto talk = conversation.talk();
    const OrbRequests by_orb;
    talk->note(1, 1000);
    CORBA::ULong noted_by_then = 1;
    std::thread([&] { noted_by_then = Testing::Longs_var(talk->noted())->length(); }).join();
    CHECK(noted_by_then == 0);
    for (int number = 2; number <= 10; ++number) talk->note(number, 0);
    Testing::Longs_var noted(talk->noted());
    REQUIRE(noted->length() == 10);
    for (CORBA::ULong i = 0; i < 10; ++i) CHECK(noted[i] == CORBA::Long(i) + 1);
    CHECK(by_orb.count() == 0);
}

TEST_CASE("A call within a oneway call runs while as many oneway calls wait as the queue has places") {
    const Conversation conversation({"manager.service_call_timeout:60"});
    const auto talk = conversation.talk();
    const PortableServer::Servant_var<LateCaller> caller(new LateCaller(talk.object));
    const Testing::Listener_var listener = caller->_this();
    const OrbRequests by_orb;
    talk->tell(listener.in());
    for (int number = 1; number <= 15; ++number) talk->note(number, 0); // they wait for the first call
    caller->may_call_ = true;
    caller->may_call_.notify_all();
    const Testing::Longs_var noted(talk->noted());
    CHECK(noted->length() == 15);
    CHECK(caller->has_answer_);
    CHECK(by_orb.count() == 0);
}

TEST_CASE("Nested and simultaneous service calls do not block each other, more than the queue carries go by "
          "the ORB") {
    const Conversation conversation;
    const auto talk = conversation.talk();
    const PortableServer::Servant_var<Nested> nested(new Nested(talk.object)); // the POA deletes it
    const Testing::Listener_var listener = nested->_this();
    CHECK(talk->call_back(listener.in(), 40) == 80); // more calls within calls than the queue has slots
    const OrbRequests by_orb;
    std::atomic<int> answered{0};
    std::vector<std::thread> threads;
    for (int i = 0; i < 24; ++i)
        threads.emplace_back([&] {
            talk->wait_for(500);
            ++answered;
        });
    for (auto& thread : threads) thread.join();
    CHECK(answered == 24);
    CHECK(by_orb.count() <= 24);
    CHECK(by_orb.count() >= 8);
    const OrbRequests later;
    CHECK(talk.repeat_is("again"));
    CHECK(later.count() == 0);
}

TEST_CASE("A service call through shared memory has the time limit of service calls") {
    const Conversation conversation({"manager.service_call_timeout:0.3"});
    const auto talk = conversation.talk();
    CHECK_THROWS_AS(talk->wait_for(3000), CORBA::TIMEOUT);
    CHECK(talk.repeat_is("later"));
}

TEST_CASE("Service calls go by the ORB while calls whose time is over keep the queue full") {
    const Conversation conversation({"manager.service_call_timeout:3"});
    const auto talk = conversation.talk();
    std::vector<std::thread> threads;
    for (int i = 0; i < 16; ++i)
        threads.emplace_back([&] {
            try {
                talk->wait_for(60'000);
            } catch (const CORBA::TIMEOUT&) { // as expected: the next call finds the queue full
            }
        });
    for (auto& thread : threads) thread.join();
    const OrbRequests by_orb;
    CHECK(talk.repeat_is("later"));
    CHECK(by_orb.count() == 1);
}

TEST_CASE("A provider that is killed ends its calls, and further calls say that it cannot be reached") {
    Conversation conversation;
    const auto talk = conversation.talk();
    std::thread killer([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        conversation.other.host.send_signal(SIGKILL);
    });
    CHECK_THROWS_AS(talk->wait_for(60'000), CORBA::COMM_FAILURE);
    killer.join();
    conversation.other.host.wait_for_exit();
    CHECK_THROWS_AS(talk->repeat("x"), CORBA::TRANSIENT);
    CHECK(no_file_remains());
}

TEST_CASE("A provider that is killed between two calls cannot be reached") {
    Conversation conversation;
    conversation.other.host.send_signal(SIGKILL);
    conversation.other.host.wait_for_exit();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    CHECK_THROWS_AS(conversation.talk()->repeat("x"), CORBA::TRANSIENT);
}

TEST_CASE("Service ports that are connected again share calls again") {
    Conversation conversation;
    for (int i = 0; i < 3; ++i) {
        CHECK(conversation.client->port_.disconnect_all() == RTC::RTC_OK);
        CHECK(CORBA::is_nil(conversation.client->talk_._ptr()));
        conversation.connect();
        CHECK(conversation.talk().repeat_is(
            "ready")); // the first call asks by the ORB whether the object is there
        const OrbRequests by_orb;
        CHECK(conversation.talk().repeat_is("hello"));
        CHECK(by_orb.count() == 0);
        CHECK(no_file_remains());
    }
}
