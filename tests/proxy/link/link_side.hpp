// SPDX-License-Identifier: Apache-2.0
// One side of a link for tests, so that one process can have both.
#pragma once

#include "proxy/link/link.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <filesystem>
#include <functional>
#include <unistd.h>

namespace tandem::link::test {

using namespace std::chrono_literals;

/// Bounds that only a broken link reaches.
constexpr auto soon = 10s;

inline bool eventually(const std::function<bool()>& condition) {
    const auto deadline = std::chrono::steady_clock::now() + soon;
    while (std::chrono::steady_clock::now() < deadline) {
        if (condition()) return true;
        std::this_thread::sleep_for(1ms);
    }
    return false;
}

inline std::string unique_name(const std::string& what) { return fmt::format("test-{}-{}", what, getpid()); }

inline std::size_t segments_of(const std::string& link) {
    std::size_t count = 0;
    for (const auto& file : std::filesystem::directory_iterator("/dev/shm"))
        if (file.path().filename().string().find(link) != std::string::npos) ++count;
    return count;
}

inline PortTable joystick_table() {
    return {{{"Joystick0"}},
            {{PortKind::data_out, "reference", "T", "ad", "", {}},
             {PortKind::data_in, "position", "T", "ad", "", {}}}};
}

struct LinkSide : LinkHandler {
    LinkSide(shm::Side side, LinkOptions options, PortTable table)
        : link(side, std::move(options), std::move(table), *this) {}
    ~LinkSide() override { link.close(); }

    std::string check_peer_ports(PortTable& peer) override {
        table = peer;
        return refusal;
    }
    void link_state_changed(bool up) override { ++(up ? ups : downs); }
    void deadline_missed(const std::string& port) override { missed.push_back(port); }
    void peer_connected() override { ++came; }
    void peer_disconnected() override {
        on_departure();
        ++went;
    }
    Reply serve(const Request& request) override { return on_call(request); }

    PortTable table;
    std::string refusal;
    std::function<Reply(const Request&)> on_call = [](const Request& request) {
        return Reply{CallStatus::ok, {request.arguments.begin(), request.arguments.end()}};
    };
    std::function<void()> on_departure = [] {};
    std::vector<std::string> missed; ///< [supervisor-thread]
    std::atomic<int> ups{0}, downs{0}, came{0}, went{0};
    Link link;
};

inline std::unique_ptr<LinkSide> adaptor(const std::string& name) {
    return std::make_unique<LinkSide>(shm::Side::first, LinkOptions{name}, PortTable{});
}
inline std::unique_ptr<LinkSide> interceptor(const std::string& name) {
    return std::make_unique<LinkSide>(shm::Side::second, LinkOptions{name}, joystick_table());
}

inline void wait_until_up(LinkSide& a, LinkSide& b) {
    for (LinkSide* side : {&a, &b}) side->link.wait_until_up(soon, "peer");
}

inline bool send(ChannelWriter& writer, double value) {
    return writer.write(7, [&](wire::CdrWriter& out) { out.put(value); });
}
inline std::optional<double> receive(ChannelReader& reader) {
    std::optional<double> value;
    reader.read(false,
                [&](const shm::Record& record) { value = wire::CdrReader(record.bytes).get<double>(); });
    return value;
}

inline std::vector<std::byte> bytes_of(std::string_view text) {
    const auto* begin = reinterpret_cast<const std::byte*>(text.data());
    return {begin, begin + text.size()};
}

} // namespace tandem::link::test
