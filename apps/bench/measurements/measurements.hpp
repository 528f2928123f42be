// SPDX-License-Identifier: Apache-2.0
// The measurements. Each is a template over an Endpoint, a class that each side creates from its Session, with
//     void send(sequence)          sends a message of session.bytes(), with the sequence number in all words
//     std::uint64_t receive()      waits for the next message in the case's wake mode; returns its checked number
// Measurements of calls take a Client with call(sequence) and a Server with serve(), which returns the answered
// number. They are templates, because a virtual call would be part of each measured time. No wait here has a
// timeout: the driver kills both sides when the case takes too long.
#pragma once
#include "apps/bench/harness/payload.hpp"
#include "apps/bench/harness/session.hpp"

namespace tandem::bench {

/// Throws std::runtime_error if a message was lost, repeated or overtaken.
inline void require_sequence(std::uint64_t got, std::uint64_t wanted) {
    if (got != wanted) detail::throw_out_of_order(got, wanted);
}

/// Side B of a round trip: sends every message back, up to and including the stop message.
template <class Endpoint>
void echo_until_stop(Endpoint& endpoint) {
    for (;;) {
        const std::uint64_t sequence = endpoint.receive();
        endpoint.send(sequence);
        if (sequence == stop_sequence) return;
    }
}

/// Side A of a round trip: times exchange(sequence), which sends a message and returns the number of the
/// answer.
template <class Exchange>
void time_round_trips(Session& session, Exchange&& exchange, std::size_t parts = 1) {
    std::uint64_t sequence = 1;
    const auto loop = [&] {
        for (; session.needs_more(); ++sequence) {
            const std::uint64_t sent = ticks();
            const std::uint64_t answered = exchange(sequence);
            const std::uint64_t now = ticks();
            require_sequence(answered, sequence);
            session.add_sample(now - sent, now);
        }
    };
    session.begin_warm_up(parts);
    loop();
    session.begin_measuring(parts);
    loop();
    session.end_measuring();
    exchange(stop_sequence);
}

/// Measures round trips, one after the other. The case's divisor of 2 turns them into one-way times, for which
/// the clocks of two cores need not agree.
template <class Endpoint>
void measure_round_trips(Session& session) {
    Endpoint endpoint(session);
    session.arrive_and_wait();
    if (!session.is_side_a()) return echo_until_stop(endpoint);
    time_round_trips(session, [&](std::uint64_t sequence) {
        endpoint.send(sequence);
        return endpoint.receive();
    });
}

/// Measures round trips in several regions of the session's memory, one after the other, as Endpoint(session,
/// region). The distance of a cache line from a core depends on its address, so the result of a single place
/// would depend on chance.
template <class Endpoint>
void measure_round_trips_in_regions(Session& session, std::size_t regions) {
    for (std::size_t region = 0; region < regions; ++region) {
        Endpoint endpoint(session, region);
        const auto exchange = [&](std::uint64_t sequence) {
            endpoint.send(sequence);
            return endpoint.receive();
        };
        session.arrive_and_wait();
        if (session.is_side_a())
            time_round_trips(session, exchange, regions);
        else
            echo_until_stop(endpoint);
    }
}

/// Measures calls, one after the other: A is the client, B the server.
template <class Client, class Server>
void measure_calls(Session& session) {
    if (session.is_side_a()) {
        Client client(session);
        session.arrive_and_wait();
        time_round_trips(session, [&](std::uint64_t sequence) { return client.call(sequence); });
        session.arrive_and_wait();
    } else {
        Server server(session);
        session.arrive_and_wait();
        while (server.serve() != stop_sequence) {
        }
        session
            .arrive_and_wait(); // the client must have its last reply before the server's memory is released
    }
}

/// Measures round trips that are due every millisecond. Each counts from when it was due, not from when it was
/// sent: a stall also delays the following messages and shows in each of them (no coordinated omission).
template <class Endpoint>
void measure_paced(Session& session) {
    Endpoint endpoint(session);
    session.arrive_and_wait();
    if (!session.is_side_a()) return echo_until_stop(endpoint);
    const std::uint64_t interval = to_ticks(1e6);
    session.begin_measuring();
    std::uint64_t due = ticks() + interval;
    for (std::uint64_t sequence = 1; session.needs_more(); ++sequence, due += interval) {
        while (ticks() < due) {
        }
        endpoint.send(sequence);
        require_sequence(endpoint.receive(), sequence);
        const std::uint64_t now = ticks();
        session.add_sample(now - due, now);
    }
    session.end_measuring();
    endpoint.send(stop_sequence);
    endpoint.receive();
}

/// Measures what send() costs the writer: one message every 5 us while B receives, so that the ring is empty
/// and B waits in its wake mode each time.
template <class Endpoint>
void measure_publish(Session& session) {
    Endpoint endpoint(session);
    session.arrive_and_wait();
    if (!session.is_side_a()) {
        while (endpoint.receive() != stop_sequence) {
        }
        return;
    }
    const std::uint64_t gap = to_ticks(5e3);
    std::uint64_t sequence = 1;
    const auto loop = [&] {
        for (; session.needs_more(); ++sequence) {
            const std::uint64_t before = ticks();
            endpoint.send(sequence);
            const std::uint64_t after = ticks();
            session.add_sample(after - before, after);
            while (ticks() - after < gap) {
            }
        }
    };
    session.begin_warm_up();
    loop();
    session.begin_measuring();
    loop();
    session.end_measuring();
    endpoint.send(stop_sequence);
}

/// Measures the rate of messages sent without a pause: A fills and sends; B receives, sums, and counts over
/// windows of time. Results: GB/s, or million messages per second, one for each window. No message may be lost.
template <class Endpoint>
void measure_stream(Session& session) {
    Endpoint endpoint(session);
    session.arrive_and_wait();
    // For short messages, the clock and the stop flag are checked once per 64 messages: either check costs as
    // much as a message.
    const std::uint64_t batch = session.bytes() <= 4096 ? 64 : 1;
    if (session.is_side_a()) {
        for (std::uint64_t sequence = 1; !session.stop_requested();)
            for (std::uint64_t i = 0; i < batch; ++i) endpoint.send(sequence++);
        endpoint.send(stop_sequence);
        session.arrive_and_wait();
        return;
    }
    const bool in_gigabytes = session.bench_case().unit == Unit::gigabytes_per_second;
    // For one message: bytes per ns are GB/s, 1000 messages per ns are millions per second.
    const double unit = in_gigabytes ? static_cast<double>(session.bytes()) : 1e3;
    const std::uint64_t window = to_ticks(session.budget().window_seconds * 1e9);
    std::uint64_t expected = 1;
    for (int i = -1; i < session.budget().windows; ++i) { // the first is warm-up
        const std::uint64_t first = expected, begin = ticks();
        std::uint64_t now = begin;
        while (now - begin < window) {
            for (std::uint64_t k = 0; k < batch; ++k, ++expected)
                require_sequence(endpoint.receive(), expected);
            now = ticks();
        }
        if (i >= 0) session.add_result(static_cast<double>(expected - first) * unit / to_ns(now - begin));
    }
    session.request_stop();
    for (std::uint64_t got = 0; got != stop_sequence;) { // messages that A had sent before it saw the request
        got = endpoint.receive();
        if (got != stop_sequence) require_sequence(got, expected++);
    }
    session.arrive_and_wait();
}

} // namespace tandem::bench
