// SPDX-License-Identifier: Apache-2.0
// What the observing commands do with a link whose owner rewrites it before and while they read it: `tandem record`, `echo`,
// `hz` and `top` find ports, follow messages and calls, and write them as JSON, IDL and a recording.
#include "mutated_atomics.hpp"

#include "apps/tandem/observe/link_follower.hpp"
#include "apps/tandem/observe/message_idl.hpp"
#include "apps/tandem/observe/message_json.hpp"
#include "apps/tandem/record/recorder.hpp"
#include "proxy/link/session/link_session.hpp"
#include "tests/apps/tandem/mcap/memory_sink.hpp"

#include <cstdio>
#include <cstdlib>

namespace {

using namespace tandem;
using shm::fuzz::Input;
using shm::fuzz::Mutator;

constexpr const char* signatures[] = {"{tm}({sec}u{nsec}u){data}d", "{tm}({sec}u{nsec}u){data}ad",
                                      "{s}s{l}a({x}d{n}s){m}[3]i", "<e#3;0={i}i;1,2={s}ad;*=(sv)>aw"};
constexpr std::size_t max_rounds = 16;

/// A link with ports of several types; both sides are this process.
class HostileLink {
  public:
    HostileLink() : name("fuzz-observe-" + std::to_string(getpid())) {
        shm::JoinOptions options;
        options.arena_bytes = std::size_t{256} << 10;
        first_ = shm::Segment::join(name, shm::Side::first, options);
        second_ = shm::Segment::join(name, shm::Side::second, options);
        link::PortTable table;
        table.components = {{.name = "Sensor0", .type = "Sensor"}};
        table.model = "OPRoS";
        for (const char* signature : signatures) add_port(table, signature);
        const auto bytes = encode(table);
        const auto blob = first_->add_blob(link::table_name, link::published_table_bytes(bytes.size(), true));
        link::write_published_table(blob, bytes, 1);
        first_->add_call_queue(link::calls_name,
                               {.callers = shm::Side::second, .slots = 2, .max_bytes = 400});
        first_->publish();
        // The mapping begins where the arenas' offset says, before the first object.
        std::byte* begin = first_->list(shm::Side::first).front().memory.data() - shm::layout::arenas_begin;
        everything = {begin, shm::layout::arenas_begin + options.arena_bytes};
        pristine_.assign(everything.begin(), everything.end());
    }
    void restore() { std::copy(pristine_.begin(), pristine_.end(), everything.begin()); }
    /// Sends any bytes: messages of the peer need not be values of the port's type.
    void send(Input& input) {
        std::vector<std::byte> message(input.byte());
        for (auto& byte : message) byte = static_cast<std::byte>(input.byte());
        const auto ring = first_->find_ring(shm::Side::first, names_[input.byte() % names_.size()]);
        if (ring) shm::RingWriter(*ring).write(message, input.number(8));
    }
    /// Rewrites headers and directories, an object, or the port table.
    void rewrite(Input& input) {
        const auto objects = first_->list(shm::Side::first);
        const std::uint8_t what = input.byte();
        const bool header = what % 4 == 0;
        Mutator::unleash(input, header ? everything.first(8192) : objects[what / 4U % objects.size()].memory,
                         header ? 0 : sizeof(shm::layout::RingHeader));
        Mutator::rewrite();
    }

    const std::string name;
    std::span<std::byte> everything;

  private:
    void add_port(link::PortTable& table, const char* signature) {
        link::Port port;
        port.kind = link::PortKind::data_out;
        port.name = "p" + std::to_string(table.ports.size());
        port.type = "IDL:M/T:1.0";
        port.signature = signature;
        port.component = "Sensor0";
        names_.push_back(link::ring_name(port));
        first_->add_ring(names_.back(), {.writer = shm::Side::first,
                                         .max_record = 200,
                                         .capacity = 1024,
                                         .chunk_bytes = 4096,
                                         .chunks = 2});
        table.ports.push_back(std::move(port));
    }

    std::unique_ptr<shm::Segment> first_, second_;
    std::vector<std::string> names_;
    std::vector<std::byte> pristine_;
};

/// Decodes a message as `tandem echo` does.
void show(const command::LinkFollower::Port& port, const shm::FollowedRecord& record) {
    try {
        command::message_to_json(port, record.bytes, record.stamp)
            .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    } catch (
        const std::exception&) { // bytes that are not a value of the type; echo prints them in hexadecimal
    }
    command::message_idl(port);
}

void run(HostileLink& link, Input& input) {
    command::LinkFollower follower(link.name, {});
    follower.begin_with_oldest();
    test::MemorySink sink;
    mcap::McapWriter writer(sink, {});
    command::Recorder recorder(writer, {link.name}, {});
    recorder.begin_with_oldest();
    for (std::size_t round = 0; round < max_rounds && !input.used_up(); ++round) {
        const std::uint8_t what = input.byte();
        // list() of the link itself reads the directory, which may be damaged by now.
        try {
            if (what % 3 == 0) link.send(input);
            if (what % 2 == 0) link.rewrite(input);
        } catch (const shm::Error&) {
        }
        follower.poll([&](const command::LinkFollower::Port& port, const shm::FollowedRecord& record) {
            show(port, record);
            Mutator::look();
        });
        recorder.poll();
        Mutator::restrain();
    }
    recorder.write_drops();
    writer.close();
}

} // namespace

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer looks for
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static HostileLink link;
    Input input(data, size);
    try {
        run(link, input);
    } catch (const shm::Error&) { // one line each, as the command prints it
    } catch (const mcap::Error&) {
    }
    Mutator::restrain();
    link.restore();
    return 0;
}
