// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace tandem::bench {

/// [0] the sequence number; [1] BenchPing's clock at sending, [2] BenchPong's at receiving, [3] BenchPong's at
/// sending, each as the bits of a tick count; [4] not 0: from now on BenchPong sends once in each of its ticks; [5]
/// milliseconds that it polls from then on before it gives its thread back; [6] of a case of tails: by how many ns the tick was
/// late that sends it; the rest is payload.
using PingMessage = std::array<double, 8>;
constexpr std::size_t ping_sent_at = 1, pong_sent_at = 3; ///< its elements

inline double as_double(std::uint64_t bits) { return std::bit_cast<double>(bits); }
inline std::uint64_t as_bits(double value) { return std::bit_cast<std::uint64_t>(value); }

/// How long one onExecute() polls: the host gets its thread back in between, and can stop the component.
constexpr double slice_ns = 20e6;

} // namespace tandem::bench
