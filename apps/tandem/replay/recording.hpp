// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/reader.hpp"
#include "apps/tandem/observe/followed_port.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tandem::command {

/// A recorded link and its shared ports.
struct RecordedLink {
    std::string name;
    link::PortTable tables[2]; ///< of both sides, at the end of the recording
    const link::PortTable& table(shm::Side side) const { return tables[shm::index_of(side)]; }
    /// Returns whether AdaptorComp was this side, which activates the components of the other one.
    bool is_adaptor(shm::Side side) const;
    /// Returns the program that ran the side's components, by the model in its table; empty if the model is unknown.
    std::string host_of(shm::Side side) const;
};

/// A channel of a recording.
struct RecordedChannel {
    enum class Kind { message, request, reply, failure, step } kind = Kind::message;
    std::string link, port, topic;
    shm::Side sender{}; ///< of a message; of the other kinds: the callers
    std::string operation{}, operation_signature{};
    wire::Type type{};  ///< of a message, or of a request or reply with the number of the call first
    bool timed = false; ///< of a message: it begins with RTM's time
};

/// One recorded event. Valid until the next one is read.
struct RecordedEvent {
    const RecordedChannel* channel = nullptr;
    std::uint64_t time_ns = 0; ///< when the recorder saw it
    std::uint64_t stamp = 0;   ///< of a message: as its sender has set it
    std::span<const std::byte>
        bytes;              ///< CDR; a message without its time, a request or reply without its number
    std::uint64_t call = 0; ///< number of the call
    std::uint64_t tick = 0; ///< of a step
    std::string host{}, component{}; ///< of a step
};

/// A file written by `tandem record` or by a lock-step with --record. [one thread]
class Recording {
  public:
    /// Throws std::runtime_error with one line if the file is not such a recording.
    explicit Recording(const std::filesystem::path& file);

    const std::map<std::string, RecordedLink>& links() const { return links_; }
    /// Returns whether the recording has the cycles of a lock-step.
    bool has_steps() const { return has_steps_; }
    std::uint64_t tick_ns() const { return tick_ns_; } ///< of that lock-step
    /// Returns a line for each part that could not be read so far.
    const std::vector<std::string>& problems() const { return problems_; }

    /// Restarts reading from the beginning, in order of time.
    void rewind();
    /// Returns the next event; nullopt at the end. Throws std::runtime_error if a message does not match
    /// its channel's type.
    std::optional<RecordedEvent> next();

  private:
    void read_metadata();
    void read_channels();

    const std::filesystem::path file_;
    mcap::McapReader reader_;
    std::map<std::string, RecordedLink> links_;
    std::map<std::uint16_t, RecordedChannel> channels_;
    std::optional<mcap::MessageCursor> cursor_;
    std::vector<std::string> problems_;
    std::vector<std::uint64_t> bytes_; ///< of the event; words, for their alignment
    bool has_steps_ = false;
    std::uint64_t tick_ns_ = 0;
};

} // namespace tandem::command
