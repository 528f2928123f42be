// SPDX-License-Identifier: Apache-2.0
// A link within this process, and the mirrors of one port of the peer in each direction.
#pragma once

#include "proxy/adaptor/data/mirror_in_port.hpp"
#include "proxy/adaptor/data/mirror_out_port.hpp"
#include "tests/proxy/link/link_side.hpp"

#include <InputDataPort.h>
#include <OutputDataPort.h>

#include <catch2/catch.hpp>

namespace tandem::adaptor::test {

using link::PortKind;
using link::test::unique_name;

/// A port of the peer, `in` for what OPRoS sends and `out` for what it receives, on a link within this process.
struct Wire {
    Wire(const std::string& what, const std::string& type, const std::string& signature)
        : in{PortKind::data_in, "in", type, signature, "", {}}, out{PortKind::data_out, "out", type,
                                                                    signature,          "",    {}},
          peer(shm::Side::second, options(what), {{}, {in, out}}), own(shm::Side::first, options(what), {}) {
        peer.link.open();
        own.link.open();
        peer.link.wait_until_up(link::test::soon, "peer");
        own.link.wait_until_up(link::test::soon, "peer");
    }
    static link::LinkOptions options(const std::string& what) {
        link::LinkOptions options;
        options.name = unique_name(what);
        return options;
    }
    /// The next message that the peer received.
    std::vector<std::byte> received(std::uint64_t* stamp = nullptr) {
        std::vector<std::byte> bytes;
        peer.link.reader("in").read(false, [&](const shm::Record& record) {
            bytes.assign(record.bytes.begin(), record.bytes.end());
            if (stamp) *stamp = record.stamp_ns;
        });
        return bytes;
    }
    void send(const std::vector<std::byte>& bytes, std::uint64_t stamp = 0) {
        peer.link.writer("out").write_sized(bytes.size(), stamp, [&](std::span<std::byte> room) {
            std::copy(bytes.begin(), bytes.end(), room.begin());
            return true;
        });
    }
    /// Sends a value and returns the received bytes to the port; the value must arrive unchanged.
    template <class T>
    std::unique_ptr<opros_any> there_and_back(const T& value, const std::string& convert_in = "",
                                              const std::string& convert_out = "") {
        adaptor::MirrorInPort input(in, own.link.writer("in"), convert_in);
        opros_any any(value), sample{T()}; // a separate sample, because copies of an image share the pixels
        const bool accepted = input.checkType(sample);
        INFO(input.typeError());
        REQUIRE(accepted);
        REQUIRE(input.push(any) == OPROS_SUCCESS);
        std::uint64_t stamp = 0;
        const auto bytes = received(&stamp);
        InputDataPort<T> target(OPROS_FIFO, 4); // outlives the port whose target it is
        adaptor::MirrorOutPort output(
            out, own.link.reader("out"), [](DataPortListener*) {}, convert_out);
        const bool fits = output.checkType(&target);
        INFO(output.typeError());
        REQUIRE(fits);
        send(bytes, stamp);
        return std::unique_ptr<opros_any>(target.pop());
    }

    link::Port in, out;
    link::test::LinkSide peer, own;
};

template <class T>
T& content(const std::unique_ptr<opros_any>& any) {
    REQUIRE(any);
    return *opros_any_cast<T>(any.get());
}

} // namespace tandem::adaptor::test
