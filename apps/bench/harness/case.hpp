// SPDX-License-Identifier: Apache-2.0
// A case is one row of the report: what is measured, on what, in which wake mode and regime.
#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace tandem::bench {

class Session;

enum class Group { baseline, tandem, peer };

/// How the waiting side waits.
enum class Wake { none, spin, spin_then_futex, blocking };

/// normal: an idle core halts. low_latency_idle: /dev/cpu_dma_latency held at 0. same_core: both on core a.
/// loaded: one process that only computes on each core.
enum class Regime { normal, low_latency_idle, same_core, loaded };

/// processes: A and B are processes of their own. threads: of one process. alone: only A.
enum class Placement { processes, threads, alone };

enum class Unit { ns, gigabytes, megamessages, count };

struct Case {
    Group group = Group::tandem;
    std::string subject;   ///< "index-ring", "ring", "iceoryx"
    std::string operation; ///< "one-way", "call", "stream", ...
    std::size_t bytes = 64;
    Wake wake = Wake::spin;
    Regime regime = Regime::normal;
    Placement placement = Placement::processes;
    Unit unit = Unit::ns;
    double divisor = 1;                ///< samples are divided by it: 2 for one way by round trip
    double extra_seconds = 0;          ///< a case that takes longer than the others by its nature
    std::string detail;                ///< what else tells it from its neighbours: "loan", "256 ports"
    std::string service;               ///< a program that must run meanwhile: "iox-roudi"
    std::function<void(Session&)> run; ///< [in each of the processes or threads]

    std::string id() const; ///< who/what/bytes/wake[/detail][/regime]; unique
    /// Cases of one topic are measured one after the other, so that a ratio's two sides are close in time.
    std::string topic() const;
};

struct Skipped {
    std::string subject, reason;
};

struct Registry {
    std::vector<Case> cases;
    std::vector<Skipped> skipped; ///< peers that this build does not have

    /// The case in each regime that its wake mode makes sense in.
    void add_regimes(const Case& entry);
};

/// All cases, by topic.
Registry all_cases();

const char* name_of(Group group);
const char* name_of(Wake wake);
const char* name_of(Regime regime);
const char* name_of(Placement placement);
const char* name_of(Unit unit);
std::string size_text(std::size_t bytes); ///< "64", "4K", "6M"

} // namespace tandem::bench
