// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/writer.hpp"
#include "apps/tandem/observe/link_follower.hpp"
#include "apps/tandem/record/call_writer.hpp"
#include "apps/tandem/record/drops.hpp"
#include "apps/tandem/record/recording_clock.hpp"

#include <atomic>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tandem::command {

/// Writes the messages of links to an MCAP file. Each data port is a channel `/LINK/PORT` of CDR messages
/// with DDS's encapsulation header (OMG DDSI-RTPS 2.5, section 10.2.1.2; little endian, XCDR1) and the
/// port's type as IDL. See CallWriter for service calls. Log time: when this program saw the message, see
/// RecordingClock; publish time: the sender's stamp. In a lock-step run, both are the simulated time.
/// `/LINK/tandem/drops` counts lost messages. [one thread]
class Recorder {
  public:
    /// `writer` must outlive the recorder. Throws shm::Error for an invalid link name.
    Recorder(mcap::McapWriter& writer, const std::vector<std::string>& links,
             const std::vector<std::string>& ports, RecordingClock clock = RecordingClock());

    /// Writes messages sent since the last call, and finished service calls: all of them if no call is in progress
    /// (`activity`). Returns whether it wrote anything. Ends even if writers are faster than this thread, and early when the
    /// flag of set_stop() is set. Throws mcap::Error.
    bool poll(shm::CallActivity activity = shm::CallActivity::possible,
              LinkFollower::Rings rings = LinkFollower::Rings::all);

    /// Sets a flag that poll() checks; nullptr: none. The flag must outlive this object.
    void set_stop(const std::atomic<bool>* stop) { stop_ = stop; }

    /// Sets the log time and publish time of subsequent records, for a lock-step run in simulated time.
    void set_time(std::uint64_t time_ns) { simulated_ns_ = time_ns; }
    /// Sets the log time and writes a message on `/tandem/steps` for the component's last cycle. Messages
    /// sent in the cycle are recorded after it.
    void write_step(std::uint64_t time_ns, std::uint64_t tick, const std::string& host,
                    const std::string& component);
    /// Also records messages sent before the recording began, if still available.
    void begin_with_oldest();

    /// Writes the number of dropped messages of each port since the recording began, if it has changed.
    void write_drops();
    /// Writes a message on `/tandem/clock` if the wall clock has been set since the last call.
    void write_clock_step();

    std::uint64_t messages() const { return messages_; }
    std::uint64_t calls() const { return call_writer_.calls(); }
    /// Returns the number of calls whose slots were reused before they were copied.
    std::uint64_t lost_calls() const;
    /// Returns the number of messages overwritten before they were copied.
    std::uint64_t lost() const;
    std::size_t ports() const { return channels_.size(); }
    /// Returns the names of links that have not existed so far.
    std::string absent_links() const;
    /// Returns how often the wall clock was set.
    std::uint32_t clock_steps() const { return clock_channel_.steps(); }

  private:
    /// A channel of the file and its port.
    struct Channel {
        std::uint16_t id = 0;
        std::string signature;
    };
    struct Link {
        explicit Link(LinkFollower of) : follower(std::move(of)) {}
        LinkFollower follower;
        std::uint64_t generation = 0;
        std::map<std::string, Channel> channels; ///< by port
        std::map<std::string, Drops> drops;      ///< as last written
        std::uint16_t drops_channel = 0;
        std::uint32_t drops_sequence = 0;
    };

    void add_channels(Link& link);
    void add_channel(Link& link, const LinkFollower::Port& port);
    void write(Link& link, const LinkFollower::Port& port, const shm::FollowedRecord& record);
    std::uint64_t log_time() const;
    void write_drop(Link& link, const std::string& port, const Drops& drops);
    std::uint16_t add_schema(const std::string& name, const std::string& text);

    mcap::McapWriter& writer_;
    const std::vector<std::string> port_names_;
    std::vector<Link> links_;
    CallWriter call_writer_;
    RecordingClock clock_;
    ClockChannel clock_channel_;
    std::optional<std::uint64_t> simulated_ns_; ///< of a lock-step run
    std::uint16_t steps_channel_ = 0;
    std::uint32_t steps_ = 0;
    std::map<std::pair<std::string, std::string>, std::uint16_t> schemas_; ///< by name and text
    std::map<std::string, bool> channels_;                                 ///< topics
    std::vector<std::byte> message_; ///< reused, so that messages need no allocation
    std::uint64_t messages_ = 0;
    const std::atomic<bool>* stop_ = nullptr;
};

} // namespace tandem::command
