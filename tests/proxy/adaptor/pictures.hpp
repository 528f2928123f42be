// SPDX-License-Identifier: Apache-2.0
// A picture as components have it, and ports that send and receive values of one type.
#pragma once

#include "proxy/wire/cdr.hpp"
#include "tests/proxy/adaptor/peer_ports.hpp"

#include <RawImage.h>

#include <catch2/catch.hpp>

#include <memory>
#include <string>
#include <vector>

namespace tandem::adaptor::test {

/// A picture whose load() trusts its input, like the RawImage.h of many components: it allocates width x height x pixelByte
/// bytes, and reads as many as `size` says. Counts the pictures that would have overflowed this memory.
struct BelievingImage {
    int width = 0, height = 0, pixelByte = 0;
    unsigned long size = 0;
    std::vector<char> pixels;
    static inline int overruns = 0;

    static BelievingImage of(int width, int height, int pixel_byte, std::size_t bytes) {
        return {width, height, pixel_byte, bytes, std::vector<char>(bytes, 'p')};
    }
    void save(opros::archive::oarchive& ar, const unsigned int) {
        std::string raw("raw");
        ar << OPROS_SERIALIZATION_NVP(raw) << OPROS_SERIALIZATION_NVP(width)
           << OPROS_SERIALIZATION_NVP(height) << OPROS_SERIALIZATION_NVP(pixelByte)
           << OPROS_SERIALIZATION_NVP(size);
        ar.save(pixels.data(), static_cast<long>(pixels.size()));
    }
    void load(opros::archive::iarchive& ar, const unsigned int) {
        std::string raw;
        ar >> OPROS_SERIALIZATION_NVP(raw) >> OPROS_SERIALIZATION_NVP(width) >>
            OPROS_SERIALIZATION_NVP(height) >> OPROS_SERIALIZATION_NVP(pixelByte) >>
            OPROS_SERIALIZATION_NVP(size);
        const long long room = 1LL * width * height * pixelByte;
        char* read = nullptr;
        long count = static_cast<long>(size);
        ar.load(&read, count);
        overruns += count > room || static_cast<long long>(size) != room;
        pixels.assign(read, read + count);
        delete[] read;
    }
};
inline std::string typeName(BelievingImage*) { return "RawImage"; }

inline const std::string believing_signature = "{raw}s{width}i{height}i{pixelByte}i{size}t{6}ay";

inline void put_picture(const BelievingImage& image, wire::CdrWriter& out) {
    out.put_string("raw");
    out.put(image.width);
    out.put(image.height);
    out.put(image.pixelByte);
    out.put(static_cast<std::uint64_t>(image.size));
    out.put_sequence(image.pixels.data(), image.pixels.size());
}

inline std::vector<std::byte> believing_message(const BelievingImage& image) {
    std::vector<std::byte> bytes;
    wire::CdrWriter out(bytes);
    put_picture(image, out);
    return bytes;
}

/// A component's input port of that type, connected with the peer's output port.
template <class T>
struct Receiver {
    Receiver(Wire& wire, const std::string& convert = "")
        : output(
              wire.out, wire.own.link.reader("out"), [](DataPortListener*) {}, convert) {
        const bool fits = output.checkType(&target);
        INFO(output.typeError());
        REQUIRE(fits);
    }
    std::unique_ptr<opros_any> pop() { return std::unique_ptr<opros_any>(target.pop()); }

    InputDataPort<T> target{OPROS_FIFO, 4}; // outlives the port whose target it is
    MirrorOutPort output;
};

/// Sends values from an OPRoS port to the link.
template <class T>
struct Sender {
    Sender(Wire& wire, const std::string& convert = "")
        : input(wire.in, wire.own.link.writer("in"), convert) {
        opros_any sample{T()};
        const bool fits = input.checkType(sample);
        INFO(input.typeError());
        REQUIRE(fits);
    }
    bool push(const T& value) {
        opros_any any(value);
        return input.push(any) == OPROS_SUCCESS;
    }

    MirrorInPort input;
};

} // namespace tandem::adaptor::test
