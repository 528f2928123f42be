// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/replay/answers.hpp"
#include "apps/tandem/replay/commands.hpp"
#include "apps/tandem/replay/comparison.hpp"
#include "apps/tandem/replay/recording.hpp"
#include "apps/tandem/replay/replacement.hpp"
#include "apps/tandem/replay/replay_peer.hpp"
#include "apps/tandem/replay/stepped_hosts.hpp"

#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/print_note.hpp"
#include "apps/tandem/record/end_signals.hpp"
#include "host/log/log.hpp"
#include "shm/os/clock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <iostream>
#include <list>
#include <optional>
#include <thread>

namespace tandem::command {
namespace {

using namespace std::chrono_literals;
using Kind = RecordedChannel::Kind;

/// Time limit for messages of a step, which come from threads of the host without cycles.
constexpr auto longest_way = 1s;
constexpr auto pause_between_looks = 200us;

std::atomic<bool> stop_requested = false;
void request_stop(int) { stop_requested = true; }

/// Replays a recording through stand-ins. [main-thread]
class Replay {
  public:
    explicit Replay(const ReplayOptions& options)
        : options_(options), recording_(options.file), answers_(recording_),
          replacement_(find_replacement(recording_, options)),
          rate_(options.step ? 0 : options.rate.value_or(options.lockstep.empty() ? 1 : 0)) {
        if (options.check) check_.emplace(options.times);
        for (const auto& problem : recording_.problems()) print_note("tandem: {}\n", problem);
        for (const auto& [name, side] : replacement_)
            replay_peers_.emplace_back(recording_.links().at(name), present_name(name, options), side,
                                       answers_, check());
    }

    void run_in_real_time() {
        open();
        wait_for_peers();
        std::optional<std::uint64_t> begin_ns;
        started_ns_ = shm::now_ns();
        while (const auto event = recording_.next()) {
            if (event->channel->kind == Kind::step) continue;
            if (!begin_ns) begin_ns = event->time_ns;
            if (is_sent(*event) && options_.step && !wait_for_line(describe(*event))) break;
            pace(event->time_ns - *begin_ns);
            if (stop_requested) break;
            handle(*event);
        }
        wait_for_rest();
        wait_for_readers();
        if (check_) check_->finish(false);
    }

    void run_in_lockstep() {
        const auto& [link, side] = *replacement_.begin();
        const std::string replaced = recording_.links().at(link).host_of(side);
        SteppedHosts hosts(options_, replaced);
        std::vector<SteppedComponent> components;
        if (!recording_.has_steps()) components = hosts.find_components();
        open();
        hosts.start();
        wait_for_peers();
        started_ns_ = shm::now_ns();
        if (recording_.has_steps())
            run_recorded_steps(hosts, replaced);
        else
            run_ticks(hosts, components);
        wait_for_rest();
        if (check_) check_->finish(recording_.has_steps() && !stop_requested);
        log::write_errors_only(); // the end of the hosts is expected
        in_order_ = hosts.stop(); // before the stand-ins, so that the hosts do not lose a peer
    }

    /// Prints a summary. Returns the exit code.
    int report() {
        const int code = report_answers();
        if (recording_.problems().empty()) return code;
        print_note("tandem: the replay is not the whole recording: parts of it could not be read\n");
        return 1;
    }

  private:
    int report_answers() {
        for (ReplayPeer& replay_peer : replay_peers_) replay_peer.close();
        std::string text =
            fmt::format("{}: {} messages and {} calls replayed", options_.file.string(), sent_, called_);
        if (ticks_ != 0) text += fmt::format(" in {} ticks", ticks_);
        if (refused_ != 0) text += fmt::format("; {} messages were refused or had no reader", refused_);
        print_text(text + "\n");
        if (!check_) return in_order_ ? 0 : 1;
        for (const std::string& note : check_->notes()) print_text("note: " + note + "\n");
        if (check_->different() != 0) {
            print_text(fmt::format("first difference: {}\n{} of {} answers differ\n",
                                   check_->first_difference(), check_->different(),
                                   check_->different() + check_->same()));
            return 1;
        }
        if (check_->same() == 0) {
            print_text("nothing was compared: the recording has no answers of the running host\n");
            return 1;
        }
        print_text(fmt::format("{} answers are the same, byte for byte\n", check_->same()));
        return in_order_ ? 0 : 1;
    }

    Comparison* check() { return check_ ? &*check_ : nullptr; }

    ReplayPeer* replay_peer_of(const std::string& link) {
        for (ReplayPeer& each : replay_peers_)
            if (each.recorded_name() == link) return &each;
        return nullptr;
    }

    void open() {
        for (ReplayPeer& replay_peer : replay_peers_) replay_peer.open();
    }
    void wait_for_peers() {
        for (ReplayPeer& replay_peer : replay_peers_)
            replay_peer.wait_until_active(
                std::chrono::milliseconds(static_cast<long>(1000 * options_.wait_s)),
                [] { return stop_requested.load(); });
    }

    bool is_sent(const RecordedEvent& event) {
        const auto* const replay_peer = replay_peer_of(event.channel->link);
        return replay_peer != nullptr && replay_peer->side() == event.channel->sender &&
               (event.channel->kind == Kind::message || event.channel->kind == Kind::request);
    }

    /// Sends the events of the replayed side, and expects those of the other side.
    void handle(const RecordedEvent& event) {
        ReplayPeer* const replay_peer = replay_peer_of(event.channel->link);
        if (replay_peer == nullptr) return;
        const bool own = replay_peer->side() == event.channel->sender;
        switch (event.channel->kind) {
        case Kind::message:
            if (own)
                ++(replay_peer->send(event) ? sent_ : refused_);
            else if (check_)
                check_->expect(*event.channel, event.stamp, event.bytes);
            break;
        case Kind::request:
            if (own)
                make_call(*replay_peer, event);
            else if (check_)
                check_->expect(*event.channel, 0, event.bytes);
            break;
        default: // replies: handled with their calls
            break;
        }
        poll();
    }

    void make_call(ReplayPeer& replay_peer, const RecordedEvent& request) {
        ++called_;
        const link::Reply now = replay_peer.call(request);
        const link::Reply* const then = answers_.find(request.call);
        if (!check_ || then == nullptr) return;
        const std::string topic = request.channel->topic.substr(0, request.channel->topic.rfind('/'));
        if (now.status != then->status)
            check_->differ(topic,
                           fmt::format("the recorded answer of the call is '{}', the replayed one is '{}' {}",
                                       shm::name_of(then->status), shm::name_of(now.status), now.text()));
        else if (now.bytes != then->bytes)
            check_->differ(topic, "the replies differ");
    }

    bool poll() {
        bool any = false;
        for (ReplayPeer& replay_peer : replay_peers_) any |= replay_peer.poll();
        return any;
    }

    /// With a rate, waits for the time at which the replay has come to `recorded_ns` after the begin of the recording.
    /// `hosts`: notices meanwhile when one of them ends, and a signal to end the replay.
    void pace(std::uint64_t recorded_ns, SteppedHosts* hosts = nullptr) {
        if (rate_ <= 0) return;
        const auto time_ns =
            started_ns_ + static_cast<std::uint64_t>(static_cast<double>(recorded_ns) / rate_);
        for (std::uint64_t now = shm::now_ns(); now < time_ns && !stop_requested; now = shm::now_ns()) {
            poll();
            if (hosts != nullptr) hosts->look();
            std::this_thread::sleep_for(std::min<std::chrono::nanoseconds>(
                std::chrono::nanoseconds(time_ns - now), pause_between_looks));
        }
    }

    /// Receives messages until `condition` is true, for at most longest_way. Returns the condition.
    template <class Condition>
    bool wait_for(Condition condition) {
        const auto end = std::chrono::steady_clock::now() + longest_way;
        for (poll(); !condition(); poll()) {
            if (std::chrono::steady_clock::now() >= end || stop_requested) return false;
            std::this_thread::sleep_for(pause_between_looks);
        }
        return true;
    }

    /// Waits until the messages of a tick have arrived. A topic that was waited for in vain is late: until it has caught
    /// up, further ticks do not wait for it.
    void wait_for_tick() {
        if (!check_) return;
        if (wait_for([this] { return !check_->is_waiting(); }) || stop_requested) return;
        for (const std::string& topic : check_->stop_waiting())
            print_note("tandem: {}: no answer within {} s; further ticks do not wait for it\n", topic,
                       longest_way / 1s);
    }

    /// Waits until all recorded messages have arrived.
    void wait_for_rest() {
        poll();
        if (check_) wait_for([this] { return check_->is_complete(); });
    }

    /// Messages in a ring are lost when its writer leaves.
    void wait_for_readers() {
        const auto end = std::chrono::steady_clock::now() + longest_way;
        const auto all_taken = [&] {
            return std::all_of(replay_peers_.begin(), replay_peers_.end(),
                               [](const ReplayPeer& replay_peer) { return replay_peer.all_taken(); });
        };
        while (!all_taken() && std::chrono::steady_clock::now() < end && !stop_requested) {
            poll();
            std::this_thread::sleep_for(1ms);
        }
    }

    /// Runs the recorded cycles in order. The recorded messages replace the cycles of the replaced components.
    void run_recorded_steps(SteppedHosts& hosts, const std::string& replaced) {
        std::optional<std::uint64_t> tick;
        while (const auto event = recording_.next()) {
            if (event->channel->kind != Kind::step) {
                handle(*event);
                continue;
            }
            if (stop_requested) return;
            if (tick != event->tick) {
                if (tick) wait_for_tick(); // the previous one
                tick = event->tick;
                ++ticks_;
                if (check_) check_->set_tick(*tick);
                if (options_.step && !wait_for_line(fmt::format("tick {}", *tick))) return;
                pace(event->time_ns, &hosts); // the time is that since the first tick
            }
            if (event->host != replaced) hosts.step(event->host, event->component);
            poll();
        }
    }

    /// Steps through a real-time recording. Each tick sends the events of that time, and then runs the other hosts'
    /// cycles.
    void run_ticks(SteppedHosts& hosts, const std::vector<SteppedComponent>& components) {
        const auto tick_ns = static_cast<std::uint64_t>(hosts.tick_period().count());
        std::optional<std::uint64_t> end_ns; // end of the tick
        const auto run_tick = [&] {
            for (const auto& each : components) {
                const auto period =
                    std::max<std::uint64_t>(static_cast<std::uint64_t>(each.period.count()), tick_ns);
                if ((ticks_ + 1) * tick_ns / period != ticks_ * tick_ns / period)
                    hosts.step(each.host, each.name);
                poll();
            }
            ++ticks_;
            *end_ns += tick_ns;
            pace(ticks_ * tick_ns, &hosts);
            if (check_) check_->set_tick(ticks_);
        };
        if (check_) check_->set_tick(0);
        while (const auto event = recording_.next()) {
            if (!end_ns) end_ns = event->time_ns + tick_ns;
            while (event->time_ns >= *end_ns && !stop_requested) {
                if (options_.step && !wait_for_line(fmt::format("tick {}", ticks_))) return;
                run_tick();
            }
            if (stop_requested) return;
            handle(*event);
        }
        if (end_ns) run_tick();
    }

    static std::string describe(const RecordedEvent& event) {
        return fmt::format("{}, {} bytes", event.channel->topic, event.bytes.size());
    }

    /// Returns false at the end of the input, or after a request to stop.
    bool wait_for_line(const std::string& what) {
        print_note("{}: press Enter to continue, Ctrl-D to end ", what);
        std::string line;
        return !stop_requested && static_cast<bool>(std::getline(std::cin, line)) && !stop_requested;
    }

    const ReplayOptions& options_;
    Recording recording_;
    Answers answers_;
    const Replacement replacement_;
    const double rate_;            ///< recorded seconds per second; 0: not paced
    std::uint64_t started_ns_ = 0; ///< begin of the replay
    std::optional<Comparison> check_;
    std::list<ReplayPeer> replay_peers_;
    std::uint64_t sent_ = 0, refused_ = 0, called_ = 0, ticks_ = 0;
    bool in_order_ = true;
};

} // namespace

int replay(const ReplayOptions& options) {
    Replay replay(options);
    if (!options.lockstep.empty()) {
        replay.run_in_lockstep();
        return replay.report();
    }
    handle_end_signals(request_stop);
    replay.run_in_real_time();
    return replay.report();
}

} // namespace tandem::command
