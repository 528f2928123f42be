// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/round.hpp"
#include "apps/tandem/monitor/samples/sample_clock.hpp"
#include "apps/tandem/monitor/state.hpp"
#include "apps/tandem/observe/link_follower.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>

#include <atomic>
#include <compare>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace tandem::monitor {

/// A data port of a link.
struct SamplePort {
    std::string link;
    shm::Side owner{};
    std::string name;
    auto operator<=>(const SamplePort&) const = default;
};

/// Receives the samples of the ports that it follows. [one thread]
class SampleClient {
  public:
    /// `time_ms`: since 1970. `json`: a chunk for each followed port with new samples, joined by commas.
    virtual void samples(std::uint64_t time_ms, const std::string& json) = 0;
    /// `frame`: the newest picture of a followed port, as docs/monitoring.md describes it.
    virtual void picture(const std::shared_ptr<const std::string>& frame) = 0;
    virtual const std::set<SamplePort>& ports() const = 0;
    /// `ports`: those of its ports that are not read, because the ports of other clients have reached the limit.
    virtual void left_out(const std::set<SamplePort>& ports) = 0;

  protected:
    ~SampleClient() = default;
};

/// Reads all messages of the ports that clients follow, as an observer, and decodes each once. Messages beyond its limits are
/// read in the next round or lost. The clients recognize lost ones by the numbers of the samples. [one thread]
class SampleFeed {
  public:
    static constexpr std::size_t max_ports = 64;         ///< of all clients; further ports are left out
    static constexpr std::size_t max_picture = 16 << 20; ///< bytes of a message that is a picture

    /// `state`: returns the newest State, which contains the links. `stop` ends a round early; null: no early end.
    SampleFeed(boost::asio::io_context& context, std::function<const State&()> state,
               const std::atomic<bool>* stop = nullptr)
        : timer_(context), stop_(stop), state_(std::move(state)) {}

    void add(SampleClient& client);
    void remove(SampleClient& client) { clients_.erase(&client); }

  private:
    /// A followed port. `chunks`, `message`, `frame`: what the current look has read.
    struct Followed {
        explicit Followed(const SamplePort& port) : follower(port.link, {port.name}) {}
        command::LinkFollower follower;
        std::vector<std::string> names; ///< of the numbers in the last chunk
        SampleClock clock;
        std::string chunks;
        nlohmann::ordered_json message; ///< the newest one that has more numbers than a sample; else null
        std::shared_ptr<const std::string> frame; ///< null: no new picture
        std::uint64_t whole_ns = 0; ///< time of the last message or picture that was sent as a whole
    };

    void look();
    void update_followed();
    void read_ports();
    void poll(const SamplePort& port, Followed& followed, Round& round);
    void add_sample(const SamplePort& port, Followed& followed, const command::FollowedPort& of,
                    const shm::FollowedRecord& record);
    void add_picture(const SamplePort& port, Followed& followed, const command::FollowedPort& of,
                     const shm::FollowedRecord& record);
    void send_to(SampleClient& client, std::uint64_t now_ms);

    boost::asio::steady_timer timer_;
    const std::atomic<bool>* stop_;
    bool looks_ = false;
    std::function<const State&()> state_;
    std::set<SampleClient*> clients_;
    std::map<SamplePort, Followed> followed_;
    std::set<SamplePort> left_out_;
    SamplePort first_;         ///< port that the last look began with
    std::minstd_rand order_{}; ///< of the pictures for a client
};

} // namespace tandem::monitor
