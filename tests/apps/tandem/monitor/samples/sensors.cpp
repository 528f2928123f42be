// SPDX-License-Identifier: Apache-2.0
// sensors NAME: a link with a camera, a distance sensor with 181 beams and a pose that goes round in a circle, for the test of the
// page. The picture is red on the left and blue on the right. Ends with its standard input.
#include "proxy/link/protocol/port_table.hpp"
#include "proxy/link/protocol/published_table.hpp"
#include "proxy/link/session/link_session.hpp"
#include "proxy/wire/cdr.hpp"
#include "proxy/wire/time.hpp"
#include "shm/ring/ring_reader.hpp"
#include "shm/ring/ring_writer.hpp"
#include "shm/segment.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <poll.h>
#include <unistd.h>

namespace {

using namespace tandem;

constexpr double pi = 3.14159265358979;
constexpr int width = 160, height = 120, beams = 181;

struct Sensor {
    const char *name, *type, *signature;
    std::vector<std::byte> (*message)(double t);
};

std::vector<std::byte> picture(double) {
    std::vector<std::byte> bytes;
    wire::CdrWriter out(bytes);
    for (const std::uint16_t number : {width, height, 24}) out.put(number);
    out.put_string("RGB");
    out.put(0.1);
    out.put(std::uint32_t{width * height * 3});
    for (int i = 0; i < width * height; ++i) {
        const bool left = i % width < width / 2;
        for (const int colour : {left ? 200 : 0, 0, left ? 0 : 200})
            out.put(static_cast<std::uint8_t>(colour));
    }
    return bytes;
}

/// A room of 4 m x 3 m; the beams from -90 to 90 degrees.
std::vector<std::byte> distances(double) {
    std::vector<std::byte> bytes;
    wire::CdrWriter out(bytes);
    out.put(std::uint32_t{beams});
    for (int i = 0; i < beams; ++i) {
        const double angle = (i - 90) * pi / 180, x = std::abs(std::cos(angle)),
                     y = std::abs(std::sin(angle));
        out.put(std::min(2 / std::max(x, 1e-9), 1.5 / std::max(y, 1e-9)));
    }
    for (const double number : {-pi / 2, pi / 2, pi / 180, 0.05, 10.0, 0.01, 10.0}) out.put(number);
    return bytes;
}

std::vector<std::byte> pose(double t) {
    std::vector<std::byte> bytes;
    wire::CdrWriter out(bytes);
    for (const double number : {2 * std::cos(t), 2 * std::sin(t), t + pi / 2}) out.put(number);
    return bytes;
}

const Sensor sensors[] = {
    {"camera", "IDL:RTC/CameraImage:1.0", "{width}q{height}q{bpp}q{format}s{fDiv}d{pixels}ay", picture},
    {"laser", "IDL:RTC/RangeData:1.0",
     "{ranges}ad{config}({minAngle}d{maxAngle}d{angularRes}d{minRange}d{maxRange}d{rangeRes}d{frequency}d)",
     distances},
    {"pose", "IDL:RTC/TimedPose2D:1.0", "{data}({position}({x}d{y}d){heading}d)", pose},
};

std::vector<shm::RingHandle> add_ports(shm::Segment& first) {
    link::PortTable table;
    table.components.push_back({"Robot"});
    std::vector<shm::RingHandle> rings;
    for (const Sensor& sensor : sensors) {
        link::Port port;
        port.kind = link::PortKind::data_out;
        port.name = sensor.name;
        port.type = sensor.type;
        port.signature = sensor.signature;
        port.component = "Robot";
        table.ports.push_back(port);
        rings.push_back(
            first.add_ring(link::ring_name(port.name), {.max_record = 100'000, .capacity = 1 << 20}));
    }
    const auto bytes = link::encode(table);
    link::write_published_table(
        first.add_blob(link::table_name, link::published_table_bytes(bytes.size(), false)), bytes, 1);
    first.publish();
    return rings;
}

bool input_has_ended() {
    pollfd input{0, POLLIN, 0};
    char byte = 0;
    return poll(&input, 1, 0) > 0 && read(0, &byte, 1) <= 0;
}

int run(const std::string& name) {
    shm::JoinOptions options;
    options.arena_bytes = 8 << 20;
    options.sparse = true;
    const auto first = shm::Segment::join(name, shm::Side::first, options);
    const auto rings = add_ports(*first);
    const auto second = shm::Segment::join(name, shm::Side::second, options);
    second->publish();
    std::vector<std::unique_ptr<shm::RingWriter>> writers;
    std::vector<std::unique_ptr<shm::RingReader>> readers;
    for (std::size_t i = 0; i < rings.size(); ++i) {
        writers.push_back(std::make_unique<shm::RingWriter>(rings[i]));
        readers.push_back(std::make_unique<shm::RingReader>(
            *second->find_ring(shm::Side::first, link::ring_name(sensors[i].name))));
    }
    std::puts("running");
    std::fflush(stdout);
    for (double t = 0; !input_has_ended(); t += 0.05) {
        for (std::size_t i = 0; i < rings.size(); ++i) {
            writers[i]->write(sensors[i].message(t), wire::wall_clock_stamp());
            while (readers[i]->read()) {
            }
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    try {
        return run(argv[1]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "sensors: %s\n", error.what());
        return 1;
    }
}
