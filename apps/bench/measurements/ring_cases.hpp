// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/bench/harness/registry.hpp"
#include "apps/bench/measurements/measurements.hpp"

#include <string>

namespace tandem::bench {

/// Adds the cases that the minimal ring and Tandem's ring have in common, so that their ratios compare equal
/// work. Endpoint<bytes, wake> is the ring's (measurements.hpp).
template <template <std::size_t, Wake> class Endpoint>
class RingCases {
  public:
    RingCases(Registry& registry, Group group, std::string subject)
        : registry_(registry), group_(group), subject_(std::move(subject)) {}

    /// The 64-byte cases of one wake mode; `round_trips` measures one way.
    template <Wake wake>
    void add_wake_mode(void (*round_trips)(Session&) = measure_round_trips<Endpoint<64, wake>>) {
        Case one_way = make("one-way", 64, wake);
        one_way.divisor = 2;
        one_way.run = round_trips;
        registry_.add_with_conditions(one_way);
        if constexpr (wake != Wake::blocking) { // waking a thread costs as much as waking a process
            Case threads = one_way;
            threads.placement = Placement::threads;
            registry_.add(threads);
        }
        Case loaded = one_way;
        loaded.loaded = true;
        registry_.add(loaded);

        Case paced = make("paced", 64, wake);
        paced.run = measure_paced<Endpoint<64, wake>>;
        registry_.add(paced);
        Case publish = make("publish", 64, wake);
        publish.run = measure_publish<Endpoint<64, wake>>;
        registry_.add(publish);
    }

    /// One way, polling, for the plot over sizes.
    template <std::size_t bytes>
    void add_size() {
        Case one_way = make("one-way", bytes, Wake::spin);
        one_way.divisor = 2;
        one_way.run = measure_round_trips<Endpoint<bytes, Wake::spin>>;
        registry_.add(one_way);
    }

    /// The sizes that both rings are plotted at; 6 MiB is a raw picture of two megapixels.
    void add_sizes_from_256() {
        add_size<256>();
        add_size<1024>();
        add_size<4096>();
        add_size<65536>();
        add_size<mebibyte>();
        add_size<6 * mebibyte>();
    }

    /// A stream of large messages, written and read in the way that `detail` names.
    template <class StreamEndpoint>
    void add_large_stream(std::size_t bytes, const std::string& detail) {
        Case stream = make("stream", bytes, Wake::spin);
        stream.unit = Unit::gigabytes_per_second;
        stream.detail = detail;
        stream.run = measure_stream<StreamEndpoint>;
        registry_.add(stream);
    }

    /// A stream of 64-byte messages.
    template <class StreamEndpoint>
    void add_small_stream() {
        Case stream = make("stream", 64, Wake::spin);
        stream.unit = Unit::million_messages_per_second;
        stream.run = measure_stream<StreamEndpoint>;
        registry_.add(stream);
    }

  private:
    Case make(const char* operation, std::size_t bytes, Wake wake) const {
        return {.group = group_, .subject = subject_, .operation = operation, .bytes = bytes, .wake = wake};
    }

    Registry& registry_;
    Group group_;
    std::string subject_;
};

} // namespace tandem::bench
