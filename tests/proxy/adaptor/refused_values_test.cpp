// SPDX-License-Identifier: Apache-2.0
// Values of calls that their types allow and that cannot cross.
#include "provided_port_connector.hpp"
#include "proxy/adaptor/service/mirror_provided_port.hpp"
#include "proxy/adaptor/service/mirror_required_port.hpp"
#include "proxy/link/protocol/service_exception.hpp"
#include "tests/proxy/link/link_side.hpp"

#include <catch2/catch.hpp>

#include <MethodInvokeException.h>
#include <ProvidedMethod.h>
#include <RequiredMethod.h>

using namespace tandem;
using namespace std::chrono_literals;
using Catch::Contains;
using link::CallStatus;
using link::Reply;

namespace {

const link::Port voice_port{
    link::PortKind::service_provided,
    "voice",
    "Voice",
    "",
    "voice",
    {{"say", "{text}s{letter}W:s raises IDL:Voice/Mute:1.0({why}s)"}, {"spell", ">w:"}}};

class VoiceRequired : public RequiredServicePort {
  public:
    VoiceRequired() { addMethod("say", makeRequiredMethod(&VoiceRequired::say, "say")); }
    std::string say(const std::string& text, wchar_t letter) {
        return (*reinterpret_cast<RequiredMethod<std::string>*>(getMethod("say")))(text, letter);
    }
};

/// A component's required port, connected to the mirror of a port that the other side of a link provides.
struct VoiceScene {
    explicit VoiceScene(const std::string& what)
        : name(link::test::unique_name("voice-" + what)), here(link::test::adaptor(name)),
          peer(link::test::interceptor(name)), mirror(voice_port, here->link, 5s), connector(mirror) {
        here->link.open();
        peer->link.open();
        here->link.wait_until_up(link::test::soon, "peer");
        REQUIRE(mirror.bindMethod(required.getMethod("say")) == "");
        static_cast<RequiredMethodInterface&>(*required.getMethod("say")).Connect(&connector);
    }
    std::string name;
    std::unique_ptr<link::test::LinkSide> here, peer;
    adaptor::MirrorProvidedPort mirror;
    ProvidedPortConnector connector;
    VoiceRequired required;
};

/// Returns `id text` of the exception.
template <class F>
std::string thrown_by(F call) {
    try {
        call();
    } catch (const MethodInvokeException& error) {
        return error.getId() + " " + error.what();
    }
    return "no exception";
}

struct Voice {
    std::string say(const std::string& text, wchar_t letter) {
        ++said;
        if (letter == L'!') throw MethodInvokeException("mute", "IDL:Voice/Mute:1.0", std::string("a\0b", 3));
        return text == "nul" ? std::string("a\0b", 3) : text;
    }
    void spell(std::wstring& text) {
        ++said;
        text = L"\x1f916";
    }
    int said = 0;
};

struct VoiceProvided : ProvidedServicePort {
    explicit VoiceProvided(Voice& voice) {
        addMethod("say", makeProvidedMethod(&Voice::say, &voice, "say"));
        addMethod("spell", makeProvidedMethod(&Voice::spell, &voice, "spell"));
    }
};

std::vector<std::byte> arguments_of_say(const char* text, char letter) {
    std::vector<std::byte> bytes;
    wire::CdrWriter out(bytes);
    out.put_string(text);
    for (const unsigned char byte :
         {static_cast<unsigned char>(2), static_cast<unsigned char>(0), static_cast<unsigned char>(letter)})
        out.put(byte);
    return bytes;
}

} // namespace

TEST_CASE("a call with a text that cannot cross throws at the caller, names the argument, and is not made") {
    VoiceScene scene("argument");
    int calls = 0;
    scene.peer->on_call = [&](const link::Request&) {
        ++calls;
        Reply reply;
        wire::CdrWriter(reply.bytes).put_string("said");
        return reply;
    };
    const std::string id = "IDL:omg.org/CORBA/BAD_PARAM:1.0 ";
    CHECK(thrown_by([&] { scene.required.say(std::string("a\0b", 3), L'x'); }) ==
          id + "service 'voice.say': argument 1 cannot cross: a string contains a NUL");
    CHECK(thrown_by([&] { scene.required.say("a", static_cast<wchar_t>(0x1f916)); }) ==
          id + "service 'voice.say': argument 2 cannot cross: a wide character is beyond U+FFFF");
    CHECK(calls == 0);
    CHECK(scene.required.say("a", L'x') == "said");
    CHECK(calls == 1);
}

TEST_CASE("a caller whose result does not decode learns that the call has run") {
    VoiceScene scene("result");
    scene.peer->on_call = [](const link::Request&) {
        return Reply{CallStatus::ok, std::vector<std::byte>(3)};
    };
    CHECK_THAT(thrown_by([&] { scene.required.say("a", L'x'); }),
               Contains("IDL:omg.org/CORBA/MARSHAL:1.0") && Contains("the call has run"));
    scene.peer->on_call = [](const link::Request&) {
        return link::refuse_results("operation 'say': its result cannot cross: x");
    };
    CHECK(thrown_by([&] { scene.required.say("a", L'x'); }) ==
          "IDL:omg.org/CORBA/MARSHAL:1.0 service 'voice.say': operation 'say': its result cannot cross: x");
}

TEST_CASE("a method whose result cannot cross has run, and its caller learns why") {
    adaptor::MirrorRequiredPort mirror(voice_port);
    Voice voice;
    VoiceProvided provided(voice);
    REQUIRE(mirror.bindProvided(&provided) == "");
    const auto refused = [&](const Reply& reply) {
        REQUIRE(reply.status == CallStatus::user_exception);
        const auto exception = link::decode_service_exception(reply.bytes);
        CHECK(exception.id == link::refused_results_id);
        return exception.text;
    };
    CHECK(refused(mirror.serve({"voice", "say", "sW:s", arguments_of_say("nul", 'x')})) ==
          "the call has run, and its result cannot cross: a string contains a NUL");
    CHECK(refused(mirror.serve({"voice", "spell", ">w:", {}})) ==
          "the call has run, and its result cannot cross: a wide character is beyond U+FFFF");
    CHECK(voice.said == 2);
    const auto thrown = mirror.serve({"voice", "say", "sW:s", arguments_of_say("a", '!')});
    CHECK(thrown.status == CallStatus::exception);
    CHECK_THAT(thrown.text(), Contains("mute") && Contains("a string contains a NUL"));
    const auto damaged = mirror.serve({"voice", "say", "sW:s", std::vector<std::byte>(2)});
    CHECK(damaged.status == CallStatus::bad_arguments);
    CHECK(voice.said == 3);
}
