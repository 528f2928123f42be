// SPDX-License-Identifier: Apache-2.0
// Caller and worker of a call queue killed after every one of their stores.
#include "death.hpp"

#include "shm/call/call_caller.hpp"
#include "shm/call/call_client.hpp"
#include "shm/call/call_server.hpp"
#include "shm/call/call_worker.hpp"
#include "tests/shm/view_as.hpp"

using namespace tandem::shm;
using namespace tandem::shm::test;

namespace {

using Caller = CallCaller<CrashPointAtomics>;
using Worker = CallWorker<CrashPointAtomics>;

constexpr CallQueueOptions two_slots{.callers = Side::first, .slots = 2, .max_bytes = 512};
constexpr std::uint64_t second_ns = 1'000'000'000;

std::vector<std::byte> payload(std::size_t bytes) { return std::vector<std::byte>(bytes, std::byte{'a'}); }

struct WorkerScenario {
    const char* name;
    std::size_t bytes; // of arguments and results: in the slot, or beyond it
    bool sleeps;
    bool closes;
};

const std::vector<WorkerScenario> workers = {
    {"a short call, polling", 8, false, false},
    {"a long call, polling", 300, false, false},
    {"a short call, asleep", 8, true, false},
    {"closing and dropping what waits", 8, false, true},
};

/// The work of IncomingCall::State, with points.
void serve(const BasicCallView<CrashPointAtomics>& view, const WorkerScenario& scenario) {
    Worker worker(view);
    worker.open();
    TakenCall call;
    bool taken = false;
    const std::uint64_t until = now_ns() + 20 * second_ns;
    for (bool polling = false; now_ns() < until;) {
        taken = worker.take(polling, call);
        if (taken) break;
        if (scenario.sleeps) {
            worker.sleep(until);
        } else {
            polling = polling || worker.try_become_poller();
            worker.spin(until);
        }
    }
    if (scenario.closes) {
        worker.close();
        worker.end_all_waits();
        worker.drop_submitted();
        worker.stop_polling();
    }
    if (!taken) return;
    worker.set_progress(call, 0.5);
    const auto results = payload(scenario.bytes);
    worker.answer(call, CallStatus::ok, results.data(), results.size());
}

} // namespace

TEST_CASE("a worker killed after any of its stores costs the caller an error at most") {
    for (const auto& scenario : workers) {
        PointNames names(std::string("worker, ") + scenario.name);
        for (unsigned k = 1, died = 1; died != 0; ++k) {
            Link link;
            auto survivor = join(link, Side::first, small(arena));
            const auto queue = survivor->add_call_queue("c", two_slots);
            survivor->publish();
            CallClient client(queue, {.mode = scenario.sleeps ? WaitMode::futex : WaitMode::spin_then_futex});
            Doomed doomed(link, Side::second, k, [&](Segment& segment) {
                serve(view_as<CrashPointAtomics>(segment.find_call_queue(Side::first, "c")->view), scenario);
            });
            const auto arguments = payload(scenario.bytes);
            const auto began = now_ns();
            const Reply reply = client.call(arguments, 300s);
            CHECK(now_ns() - began < 60 * second_ns);
            died = doomed.died() ? 1 : 0;
            CAPTURE(scenario.name, k, doomed.point(), name_of(reply.status));
            if (died != 0) names.add(doomed.point());
            REQUIRE(doomed.error() == 0);
            if (reply.status == CallStatus::ok)
                CHECK(reply.bytes == arguments);
            else
                CHECK((reply.status == CallStatus::peer_died ||
                       (scenario.closes && (reply.status == CallStatus::shut_down))));
            if (died == 0 && !scenario.closes) CHECK(reply.status == CallStatus::ok);
            const CallStatus next = client.call(arguments, 300s).status;
            CHECK((next == CallStatus::peer_died || (scenario.closes && next == CallStatus::shut_down)));
            CHECK(client.counters().in_use == 0);
            check_that_the_link_goes_on(link, survivor);
        }
        CHECK(names.count() > 0);
    }
}

namespace {

struct CallerScenario {
    const char* name;
    std::function<void(Caller&)> work;
};

CallTicket submit(Caller& caller, std::size_t bytes, bool waits) {
    CallTicket ticket;
    const auto arguments = payload(bytes);
    caller.begin(arguments.data(), bytes, 20 * second_ns, 0, waits, ticket);
    return ticket;
}

void collect(Caller& caller, const CallTicket& ticket) {
    if (caller.reply(ticket) == 0) return;
    std::vector<std::byte> results(512);
    caller.copy_results(ticket, results.data(), length_of(caller.reply(ticket)));
    caller.finish(ticket);
}

const std::vector<CallerScenario> callers = {
    {"a short call, polling",
     [](Caller& caller) {
         const auto ticket = submit(caller, 8, true);
         caller.spin(ticket, now_ns() + 20 * second_ns);
         collect(caller, ticket);
     }},
    {"a long call, asleep",
     [](Caller& caller) {
         auto ticket = submit(caller, 300, true);
         while (!caller.sleep(ticket, now_ns() + 20 * second_ns)) {
         }
         collect(caller, ticket);
     }},
    {"a call given up at once",
     [](Caller& caller) {
         const auto ticket = submit(caller, 8, false);
         if (!caller.withdraw(ticket)) collect(caller, ticket);
     }},
    {"a call given up and its successor",
     [](Caller& caller) {
         const auto first = submit(caller, 8, false);
         if (!caller.withdraw(first)) caller.finish(first);
         const auto second = submit(caller, 100, false);
         caller.spin(second, now_ns() + 20 * second_ns);
         collect(caller, second);
     }},
    {"three calls into two slots",
     [](Caller& caller) {
         submit(caller, 8, false);
         submit(caller, 8, false);
         submit(caller, 8, false);
     }},
};

} // namespace

TEST_CASE("a caller killed after any of its stores costs the server nothing") {
    const auto mode = GENERATE(WaitMode::spin_then_futex, WaitMode::futex);
    for (const auto& scenario : callers) {
        PointNames names(std::string("caller, ") + scenario.name);
        for (unsigned k = 1, died = 1; died != 0; ++k) {
            Link link;
            auto survivor = join(link, Side::second, small(arena));
            const auto queue = survivor->add_call_queue("c", two_slots);
            survivor->publish();
            CallServer server(queue, {.mode = mode});
            Doomed doomed(link, Side::first, k, [&](Segment& segment) {
                Caller caller(view_as<CrashPointAtomics>(segment.find_call_queue(Side::second, "c")->view));
                scenario.work(caller);
            });
            bool sound = true;
            const auto answer_one = [&](std::chrono::nanoseconds bound) {
                auto call = server.take(bound);
                if (!call) return false;
                for (const std::byte byte : call->arguments()) sound = sound && byte == std::byte{'a'};
                call->reply(CallStatus::ok, call->arguments());
                return true;
            };
            while (!doomed.ended()) answer_one(1ms);
            died = doomed.died() ? 1 : 0;
            CAPTURE(scenario.name, k, doomed.point());
            if (died != 0) names.add(doomed.point());
            REQUIRE(doomed.error() == 0);
            while (answer_one(0ns)) {
            }
            CHECK(sound);
            CHECK_FALSE(server.take(1us));
            CHECK(server.counters().in_use == 0);
            check_that_the_link_goes_on(link, survivor);
        }
        CHECK(names.count() > 0);
    }
}
