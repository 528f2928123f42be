// SPDX-License-Identifier: Apache-2.0
// A case is one row of the report: the measured transport or program, its operation, the number of bytes, the
// way in which its reader waits, and the state of the machine.
#pragma once
#include <cstddef>
#include <functional>
#include <string>

namespace tandem::bench {

class Session;

constexpr std::size_t mebibyte = std::size_t{1} << 20U;

/// baseline: the minimum that the hardware or hand-written code needs. tandem: what users of Tandem run. peer:
/// other middleware.
enum class Group { baseline, tandem, peer };

/// How the waiting side waits: it polls; it polls for a while and then sleeps; it sleeps at once.
enum class Wake { none, spin, spin_then_futex, blocking };

/// The state of an idle core. normal: it halts, and needs tens of microseconds to wake up. low_latency_idle:
/// /dev/cpu_dma_latency is held at 0, so the core stays in the shallowest idle state.
enum class PowerProfile { normal, low_latency_idle };

/// processes: A and B are processes, each on a separate core. same_core: processes on one core. threads:
/// threads of one process, each on a separate core. alone: there is only A.
enum class Placement { processes, same_core, threads, alone };

enum class Unit { ns, gigabytes_per_second, million_messages_per_second, count, ratio };

struct Case {
    Group group = Group::tandem;
    std::string subject = {};   ///< what is measured: "index-ring", "ring", "iceoryx"
    std::string operation = {}; ///< what it does: "one-way", "call", "stream", ...
    std::size_t bytes = 64;
    Wake wake = Wake::spin;
    PowerProfile power_profile = PowerProfile::normal;
    Placement placement = Placement::processes;
    bool loaded = false; ///< a process that only computes also runs on each core
    Unit unit = Unit::ns;
    double divisor = 1;       ///< samples are divided by it: 2 for one way by round trip
    double extra_seconds = 0; ///< added to the timeout, for a case that takes long by its nature
    std::string detail = {};  ///< distinguishes the case from similar ones: "loan", "256 ports"
    std::string daemon = {};  ///< a program that must run during the case: "iox-roudi"
    std::function<void(Session&)> run = {}; ///< [in each of the processes or threads]

    /// group/subject/operation/bytes[/wake][/detail][/threads][/conditions]; unique. --only matches it.
    std::string id() const;
    /// Returns the state of the machine: "normal", or the differences: "low-latency-idle", "same-core",
    /// "loaded".
    std::string conditions() const;
    /// Cases with the same key are measured one after the other, so that the two cases of a ratio are close in
    /// time.
    std::string comparison_key() const;
    bool needs_two_cores() const {
        return placement == Placement::processes || placement == Placement::threads;
    }
};

// The words of ids, tables and JSON files.
const char* name_of(Group group);
const char* name_of(Wake wake);
const char* name_of(PowerProfile profile);
const char* name_of(Placement placement);
const char* name_of(Unit unit);
std::string size_text(std::size_t bytes); ///< "64", "4K", "6M"

} // namespace tandem::bench
