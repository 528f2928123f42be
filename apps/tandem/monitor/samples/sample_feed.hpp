// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/round.hpp"
#include "apps/tandem/monitor/samples/message_numbers.hpp"
#include "apps/tandem/monitor/state.hpp"
#include "apps/tandem/observe/link_follower.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>

#include <atomic>
#include <compare>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace tandem::monitor {

/// A data port of a link.
struct SamplePort {
    std::string link;
    shm::Side owner{};
    std::string name;
    auto operator<=>(const SamplePort&) const = default;
};

/// Finds the times of a port's messages on the clock of this machine. [one thread]
class SampleClock {
  public:
    SampleClock();
    /// Returns the time of a message in ms since the epoch, later than that of the message before. `stamp`: see
    /// wire::pack_time().
    double time_of(std::uint64_t stamp);

  private:
    double monotonic_offset_ms_; ///< from CLOCK_MONOTONIC to CLOCK_REALTIME
    double offset_ms_ = 0, last_sent_ms_ = 0, last_ = 0;
};

/// Receives the samples of the ports that it follows. [one thread]
class SampleClient {
  public:
    /// `json`: chunks of the followed ports with samples since the last call, joined by commas.
    virtual void samples(std::uint64_t time_ms, const std::string& json) = 0;
    virtual const std::set<SamplePort>& ports() const = 0;

  protected:
    ~SampleClient() = default;
};

/// Reads all messages of the ports that clients follow, as an observer, and decodes each once. What its bounds leave out
/// is read by the next look, or is lost, which the clients recognize by the numbers of the samples. [one thread]
class SampleFeed {
  public:
    static constexpr std::size_t max_ports = 64; ///< of all clients; further ports are not followed

    /// `state`: returns the newest State, which contains the links. `stop`: ends a look early; null: nothing does.
    SampleFeed(boost::asio::io_context& context, std::function<const State&()> state,
               const std::atomic<bool>* stop = nullptr)
        : timer_(context), stop_(stop), state_(std::move(state)) {}

    void add(SampleClient& client);
    void remove(SampleClient& client) { clients_.erase(&client); }

  private:
    /// A followed port. `chunks`: what the current look has read, as JSON.
    struct Followed {
        explicit Followed(const SamplePort& port) : follower(port.link, {port.name}) {}
        command::LinkFollower follower;
        std::vector<std::string> names; ///< of the numbers in the last chunk
        SampleClock clock;
        std::string chunks;
    };

    void look();
    void update_ports();
    void read_ports();
    void poll(const SamplePort& port, Followed& followed, Round& round);
    void add_sample(const SamplePort& port, Followed& followed, const command::FollowedPort& of,
                    const shm::FollowedRecord& record);

    boost::asio::steady_timer timer_;
    const std::atomic<bool>* stop_;
    bool looks_ = false;
    std::function<const State&()> state_;
    std::set<SampleClient*> clients_;
    std::map<SamplePort, Followed> followed_;
    SamplePort first_; ///< port that the last look began with
};

} // namespace tandem::monitor
