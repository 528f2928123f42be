// SPDX-License-Identifier: Apache-2.0
// AdaptorComp, driven as a host drives it, against a peer that is only a link.
#pragma once
#include "proxy/adaptor/adaptor_comp.hpp"
#include "proxy/link/protocol/control.hpp"
#include "tests/proxy/link/link_side.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <condition_variable>
#include <fmt/format.h>
#include <mutex>
#include <string>
#include <unistd.h>
#include <vector>

namespace tandem::adaptor::test {

using link::CallStatus;
using link::PortKind;
using link::Reply;
using link::test::soon;

/// The other side without RTM: records what it receives.
struct Peer : link::LinkHandler {
    /// `activation`: how it answers to "activate". `held`: see hold().
    explicit Peer(const std::string& name, CallStatus activation = CallStatus::ok, std::string held = "")
        : held(std::move(held)), activation_status(activation),
          link(shm::Side::second, {name},
               {{{"Joystick0"}},
                {{PortKind::data_out, "reference", "IDL:RTC/TimedDoubleSeq:1.0", "(uu)ad", "", {}},
                 {PortKind::data_in, "position", "IDL:RTC/TimedDoubleSeq:1.0", "(uu)ad", "", {}},
                 {PortKind::service_provided,
                  "joystick",
                  "Joystick",
                  "",
                  "joystick",
                  {{"limits", "i:ad"}, {"name", ":s"}}},
                 {PortKind::service_required, "chair", "Chair", "", "chair", {{"limits", "i:ad"}}}}},
               *this) {
        link.open();
    }
    ~Peer() override { link.close(); }
    std::string check_peer_ports(link::PortTable&) override { return ""; }
    void link_state_changed(bool) override {}
    void deadline_missed(const std::string&) override {}
    void peer_connected() override {}
    void peer_disconnected() override {}
    Reply serve(const link::Request& request) override {
        std::unique_lock lock(mutex);
        received.push_back(std::string(request.port) + "." + std::string(request.operation));
        released.wait_for(lock, soon, [&] { return request.operation != held; });
        if (request.operation == link::control::activate && activation_status != CallStatus::ok)
            return Reply::failure(activation_status, "");
        if (request.operation == refused) return Reply::failure(CallStatus::exception, "onActivated failed");
        if (request.operation == link::control::listen) {
            const auto names = link::control::decode_port_names(request.arguments);
            link.writer("reference")
                .set_peer_listens(std::count(names.begin(), names.end(), "reference") != 0);
        }
        if (request.operation != "limits") return {};
        const auto axis = wire::CdrReader(request.arguments).get<std::int32_t>();
        Reply reply;
        wire::CdrWriter out(reply.bytes);
        out.put<std::uint32_t>(1);
        out.put(axis * 1.5);
        return reply;
    }
    /// The operation that serve() answers with an exception from now on; empty: none.
    void refuse(const std::string& operation) {
        const std::lock_guard lock(mutex);
        refused = operation;
    }
    /// The operation to which serve() does not answer before another is named, or none.
    void hold(const std::string& operation) {
        const std::lock_guard lock(mutex);
        held = operation;
        released.notify_all();
    }
    auto count(const std::string& what) {
        const std::lock_guard lock(mutex);
        return std::count(received.begin(), received.end(), what);
    }
    bool has_received(const std::string& what) { return count(what) != 0; }

    std::mutex mutex;
    std::vector<std::string> received;
    std::string refused, held; // guarded by mutex
    std::condition_variable released;
    const CallStatus activation_status;
    link::Link link;
};

struct Scene {
    explicit Scene(const std::string& what, const std::string& large_kib = "")
        : name(fmt::format("test-adaptor-{}-{}", what, getpid())), peer(name) {
        component.setId("Adaptor");
        component.setProperty("link", name);
        component.setProperty("call_timeout", "5000");
        if (!large_kib.empty()) component.setProperty("large_kib", large_kib);
        REQUIRE(component.initialize() == OPROS_SUCCESS);
        peer.link.wait_until_up(soon, "adaptor"); // it may learn of the adaptor a little later
    }
    ~Scene() { component.destroy(); }
    template <class P>
    P& port(const std::string& of) {
        return dynamic_cast<P&>(*component.getPort(of));
    }

    std::string name;
    Peer peer;
    adaptor::AdaptorComp component;
};

} // namespace tandem::adaptor::test
