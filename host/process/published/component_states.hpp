// SPDX-License-Identifier: Apache-2.0
// Publishes the states of this process's components. Other processes of the same user can read them without asking this
// process: they are in a memory file without a path (memfd_create), which they find as /proc/PID/fd/N. The file ends with
// the process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace tandem::process {

/// The states that both component models have. inactive: not started, or stopped.
enum class ComponentState : std::uint64_t { none, inactive, active, error };

struct ComponentPlace {
    std::uint64_t
        state; ///< a ComponentState; none: the place is free; written last when a component takes it
    /// The time on CLOCK_MONOTONIC at which an event-driven component began the cycle that it is in; 0: it is in none, or it
    /// has a period and so a tick (host/rt/tick_page.hpp).
    std::int64_t in_cycle_since_ns;
    char name[112]; ///< NUL-terminated and truncated to fit
};

/// A component that takes part in several execution contexts has several places.
struct ComponentStates {
    static constexpr char magic_text[8] = {'T', 'A', 'N', 'D', 'C', 'M', 'P', '1'};
    static constexpr const char* file_name = "tandem-components";
    static constexpr std::size_t places = 512;
    char magic[8];
    std::uint64_t left_out; ///< number of components that found no free place
    ComponentPlace place[places];
};

/// Lists one component for as long as this object lives. The first object creates the file. Without a file, nothing is
/// listed. [construction and destruction: any-thread]
class OwnComponentState {
  public:
    OwnComponentState(const std::string& name, ComponentState state);
    ~OwnComponentState();
    OwnComponentState(const OwnComponentState&) = delete;
    OwnComponentState& operator=(const OwnComponentState&) = delete;

    /// Publishes the new state. [any-thread]
    void set(ComponentState state) noexcept;
    /// Publishes the start of a cycle, or its end with 0. [any-thread]
    void set_in_cycle_since(std::int64_t ns) noexcept;

  private:
    ComponentPlace* place_ = nullptr;
    bool left_out_ = false;
};

} // namespace tandem::process
