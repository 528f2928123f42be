// SPDX-License-Identifier: Apache-2.0
// A link whose two sides are this process, with a port table as AdaptorComp publishes it.
#pragma once
#include "program.hpp"

#include "proxy/link/protocol/port_table.hpp"
#include "proxy/link/protocol/request.hpp"
#include "proxy/link/session/link_session.hpp"
#include "proxy/wire/cdr.hpp"
#include "proxy/wire/time.hpp"

#include <map>
#include <optional>
#include <thread>

namespace tandem::test {

/// Both sides joined; the first has the ports, and writes those that are OutPorts.
class FollowedLink {
  public:
    explicit FollowedLink(const std::vector<link::Port>& ports, const std::string& name = {}) {
        if (!name.empty()) link_.name = name;
        first_ = shm::test::join(link_, shm::Side::first);
        second_ = shm::test::join(link_, shm::Side::second);
        table_.components = {{.name = "Sensor0", .type = "Sensor"}};
        table_.ports = ports;
        table_.model = "OPRoS";
        const auto bytes = encode(table_);
        blob_ = first_->add_blob(link::table_name, link::published_table_bytes(bytes.size(), true));
        link::write_published_table(blob_, bytes, 1);
        for (const auto& port : ports) add_ring(port);
        first_->publish();
        second_->publish();
    }

    const std::string& name() const { return link_.name; }

    /// Replaces the only port by another one of that name.
    void change_port(const link::Port& port) {
        table_.ports = {port};
        add_ring(port);
        link::write_published_table(blob_, encode(table_), 2);
        first_->publish();
    }

    /// Publishes a table without ports for the second side.
    void publish_model_of_second(const std::string& model) {
        link::PortTable table;
        table.model = model;
        const auto bytes = encode(table);
        link::write_published_table(
            second_->add_blob(link::table_name, link::published_table_bytes(bytes.size(), false)), bytes, 1);
        second_->publish();
    }

    /// Sends a message of RTC::TimedDouble, whose time travels in the stamp.
    void send(const std::string& port, std::uint32_t sec, double value) {
        std::vector<std::byte> bytes;
        wire::CdrWriter(bytes).put(value);
        writers_.at(port).write(bytes, wire::pack_time(sec, 5));
    }

    /// Calls the second side, as AdaptorComp calls InterceptorComp, and answers there with that status and results.
    void call(const link::Request& request, shm::CallStatus status, std::span<const std::byte> results) {
        if (!server_) {
            server_.emplace(second_->add_call_queue(
                link::calls_name, {.callers = shm::Side::first, .slots = 4, .max_bytes = 8192}));
            second_->publish();
            client_.emplace(*first_->find_call_queue(shm::Side::second, link::calls_name),
                            shm::WaitOptions{.keep_history = true});
        }
        std::vector<std::byte> encoded;
        wire::CdrWriter out(encoded);
        encode(request, out);
        std::thread worker([&] {
            if (auto call = server_->take(std::chrono::seconds(60))) call->reply(status, results);
        });
        const auto reply = client_->call(encoded, std::chrono::seconds(60));
        worker.join();
        REQUIRE(reply.status == status);
    }

  private:
    void add_ring(const link::Port& port) {
        writers_.insert_or_assign(
            port.name,
            shm::RingWriter(first_->add_ring(
                link::ring_name(port), {.writer = shm::Side::first, .max_record = 1000, .capacity = 65536})));
    }

    shm::test::Link link_;
    link::PortTable table_;
    std::span<std::byte> blob_;
    std::unique_ptr<shm::Segment> first_, second_;
    std::map<std::string, shm::RingWriter> writers_;
    std::optional<shm::CallServer> server_;
    std::optional<shm::CallClient> client_;
};

inline link::Port timed_double_port(const std::string& name) {
    link::Port port;
    port.kind = link::PortKind::data_out;
    port.name = name;
    port.type = "IDL:RTC/TimedDouble:1.0";
    port.signature = "{tm}({sec}u{nsec}u){data}d";
    port.component = "Sensor0";
    return port;
}

} // namespace tandem::test
