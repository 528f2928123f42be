// SPDX-License-Identifier: Apache-2.0
// The measurements, each a template over an End: a class made from a Session in each side, with
//     void send(sequence)          a message of session.bytes(), the sequence number in all its words
//     std::uint64_t receive()      waits for the next in the case's wake mode; its sequence, checked
// and, for calls, a Client with call(sequence) and a Server with serve(), which returns what it answered.
// Templates, so that no virtual call stands between the clock and what is measured. No wait here has a bound
// of its own: the driver kills both sides when the case takes too long.
#pragma once
#include "apps/bench/harness/payload.hpp"
#include "apps/bench/harness/session.hpp"

namespace tandem::bench {

inline void expect_sequence(std::uint64_t got, std::uint64_t wanted) {
    if (got != wanted) detail::out_of_order(got, wanted);
}

/// Answers until the stop message.
template <class End>
void answer(End& end) {
    for (;;) {
        const std::uint64_t sequence = end.receive();
        end.send(sequence);
        if (sequence == stop_sequence) return;
    }
}

template <class Exchange>
void time_exchanges(Session& session, Exchange&& exchange, std::size_t parts = 1) {
    std::uint64_t sequence = 1;
    const auto loop = [&] {
        for (; session.more(); ++sequence) {
            const std::uint64_t sent = ticks();
            const std::uint64_t answered = exchange(sequence);
            const std::uint64_t now = ticks();
            expect_sequence(answered, sequence);
            session.sample(now - sent, now);
        }
    };
    session.begin_warm_up(parts);
    loop();
    session.begin(parts);
    loop();
    session.end();
    exchange(stop_sequence);
}

/// Round trips, one after the other; the case's divisor makes them one-way times.
template <class End>
void echo(Session& session) {
    End end(session);
    session.meet();
    if (!session.is_a()) return answer(end);
    time_exchanges(session, [&](std::uint64_t sequence) {
        end.send(sequence);
        return end.receive();
    });
}

/// The same at several places of the session's memory, one after the other, as End(session, place): how far a
/// line that stays where it is lies from a core depends on its address.
template <class End>
void echo_at_places(Session& session, std::size_t places) {
    for (std::size_t place = 0; place < places; ++place) {
        End end(session, place);
        session.meet();
        if (!session.is_a())
            answer(end);
        else
            time_exchanges(
                session,
                [&](std::uint64_t sequence) {
                    end.send(sequence);
                    return end.receive();
                },
                places);
    }
}

/// Calls: A is the client, B the server.
template <class Client, class Server>
void calls(Session& session) {
    if (session.is_a()) {
        Client client(session);
        session.meet();
        time_exchanges(session, [&](std::uint64_t sequence) { return client.call(sequence); });
        session.meet();
    } else {
        Server server(session);
        session.meet();
        while (server.serve() != stop_sequence) {
        }
        session.meet(); // so that the client has its last reply before the server goes
    }
}

/// Round trips that are due every millisecond, measured from when they were due and not from when they were
/// sent: a stall delays the following ones too, and shows in each of them.
template <class End>
void paced(Session& session) {
    End end(session);
    session.meet();
    if (!session.is_a()) return answer(end);
    const std::uint64_t interval = to_ticks(1e6);
    session.begin();
    std::uint64_t due = ticks() + interval;
    for (std::uint64_t sequence = 1; session.more(); ++sequence, due += interval) {
        while (ticks() < due) {
        }
        end.send(sequence);
        expect_sequence(end.receive(), sequence);
        const std::uint64_t now = ticks();
        session.sample(now - due, now);
    }
    session.end();
    end.send(stop_sequence);
    end.receive();
}

/// What publishing costs the writer: one message every 5 us while B reads.
template <class End>
void publish(Session& session) {
    End end(session);
    session.meet();
    if (!session.is_a()) {
        while (end.receive() != stop_sequence) {
        }
        return;
    }
    const std::uint64_t gap = to_ticks(5e3);
    std::uint64_t sequence = 1;
    const auto loop = [&] {
        for (; session.more(); ++sequence) {
            const std::uint64_t before = ticks();
            end.send(sequence);
            const std::uint64_t after = ticks();
            session.sample(after - before, after);
            while (ticks() - after < gap) {
            }
        }
    };
    session.begin_warm_up();
    loop();
    session.begin();
    loop();
    session.end();
    end.send(stop_sequence);
}

/// As fast as it goes: A fills and sends, B receives and sums and measures windows, each at least so long,
/// until it has enough. Results: GB/s, or million messages per second.
template <class End>
void stream(Session& session) {
    End end(session);
    session.meet();
    const std::uint64_t batch = session.bytes() <= 4096 ? 64 : 1;
    if (session.is_a()) {
        for (std::uint64_t sequence = 1; !session.finished();)
            for (std::uint64_t i = 0; i < batch; ++i) end.send(sequence++);
        end.send(stop_sequence);
        session.meet();
        return;
    }
    const double unit =
        session.measured().unit == Unit::gigabytes ? static_cast<double>(session.bytes()) : 1e3;
    const std::uint64_t window = to_ticks(session.limits().window_seconds * 1e9);
    std::uint64_t expected = 1;
    for (int i = -1; i < session.limits().windows; ++i) { // the first is warm-up
        const std::uint64_t first = expected, begin = ticks();
        std::uint64_t now = begin;
        while (now - begin < window) {
            for (std::uint64_t k = 0; k < batch; ++k, ++expected) expect_sequence(end.receive(), expected);
            now = ticks();
        }
        if (i >= 0) session.result(static_cast<double>(expected - first) * unit / to_ns(now - begin));
    }
    session.finish();
    for (std::uint64_t got = 0; got != stop_sequence;) {
        got = end.receive();
        if (got != stop_sequence) expect_sequence(got, expected++);
    }
    session.meet();
}

} // namespace tandem::bench
