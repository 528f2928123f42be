// SPDX-License-Identifier: Apache-2.0
// Damages each access of the code under test, one at a time, and checks whether a set of scenarios detects it.
#pragma once
#include "tests/shm/model/scenarios/case.hpp"

#include <fstream>
#include <set>

namespace tandem::shm::model {

/// Damage that no scenario can detect, and why this is acceptable. `text` is a piece of the line of source, with ^ before it
/// its beginning.
struct Spared {
    const char* file;
    const char* text;
    Damage damage;
    std::optional<Order> order; ///< none: whatever is left of it
    const char* why;
};

inline std::string name_of(const Mutation& mutation) {
    switch (mutation.damage) {
    case Damage::weaker_order:
        return std::string("made ") + name_of(mutation.order);
    case Damage::weaker_failure:
        return std::string("failure made ") + name_of(mutation.order);
    case Damage::no_comparison:
        return "made to succeed always";
    case Damage::no_store:
        return "without its store";
    case Damage::no_fence:
        return "fence removed";
    case Damage::no_wake:
        return "wake-up removed";
    }
    return "";
}

/// The next weaker orders.
inline std::vector<Order> weaker(Access access, Order order) {
    const bool loads = access == Access::load, stores = access == Access::store;
    switch (order) {
    case Order::seq_cst:
        return {loads ? Order::acquire : stores ? Order::release : Order::acq_rel, Order::relaxed};
    case Order::acq_rel:
        return {Order::acquire, Order::release};
    case Order::acquire:
    case Order::release:
        return {Order::relaxed};
    default:
        return {};
    }
}

inline std::vector<Mutation> mutations_of(const AccessLog& log) {
    std::vector<Mutation> all;
    for (const auto& [place, entry] : log.entries) {
        if (place.file.find("tests/") != std::string::npos) continue;
        const bool ordered = entry.access != Access::fence && entry.access != Access::wake;
        for (const Order order : weaker(entry.access, ordered ? entry.order : Order::relaxed))
            all.push_back({place, Damage::weaker_order, order});
        const bool compares = entry.access == Access::compare;
        if (compares)
            for (const Order order : weaker(Access::load, entry.failure))
                all.push_back({place, Damage::weaker_failure, order});
        if (compares) all.push_back({place, Damage::no_comparison});
        if (entry.access == Access::store || entry.access == Access::change)
            all.push_back({place, Damage::no_store});
        if (entry.access == Access::fence) all.push_back({place, Damage::no_fence});
        if (entry.access == Access::wake) all.push_back({place, Damage::no_wake});
    }
    return all;
}

/// The results of a run of the mutants.
struct Mutants {
    std::size_t all = 0, caught = 0, spared = 0;
    std::vector<std::string> survived; ///< and are not spared
    std::vector<std::string> by;       ///< which scenario caught which
    std::set<const Spared*> used;
};

class MutantRun {
  public:
    /// `root`: where the sources are. `effort`: random executions and steps of a search for each scenario.
    MutantRun(std::string root, std::vector<Case> cases, std::size_t random, std::size_t searched)
        : root_(std::move(root)), cases_(std::move(cases)), random_(random), searched_(searched) {}

    AccessLog accesses() const {
        AccessLog log;
        for (const auto& one : cases_) catches(one, nullptr, &log);
        return log;
    }

    Mutants run(const std::vector<Spared>& spared, bool also_spared) const {
        Mutants result;
        for (const auto& mutation : mutations_of(accesses())) {
            ++result.all;
            const std::string line = line_of(mutation.place);
            const Spared* reason = find(spared, mutation, line);
            if (reason != nullptr) {
                result.used.insert(reason);
                ++result.spared;
                if (!also_spared) continue;
            }
            const std::string what = short_name(mutation.place) + " `" + line + "` " + name_of(mutation);
            const Case* catcher = first_to_catch(mutation);
            if (catcher != nullptr) {
                ++result.caught;
                result.by.push_back(what + (reason != nullptr ? " [spared]" : "") + " | " + catcher->name);
            } else if (reason == nullptr) {
                result.survived.push_back(what);
            }
        }
        return result;
    }

  private:
    // Most mutants are caught soon by one scenario or another: each gets a little time before one gets all of it.
    const Case* first_to_catch(const Mutation& mutation) const {
        for (const std::size_t share : {20, 1})
            for (const auto& one : cases_)
                if (catches(one, &mutation, nullptr, share)) return &one;
        return nullptr;
    }

    // `share`: with that part of the effort, a 20th for instance.
    bool catches(const Case& one, const Mutation* mutation, AccessLog* log, std::size_t share = 1) const {
        Effort effort;
        effort.settings = one.settings;
        effort.mutation = mutation;
        effort.log = log;
        effort.executions = random_ / share;
        effort.seed = 1;
        if (!explore(one.scenario, effort).passed()) return true;
        effort.executions = (one.small ? 4 * searched_ : searched_) / share;
        effort.seed.reset();
        return !explore(one.scenario, effort).passed();
    }

    static std::string short_name(const Place& place) {
        return place.file.substr(place.file.rfind('/') + 1) + ":" + std::to_string(place.line);
    }
    std::string line_of(const Place& place) const {
        // A header has another path in each build folder.
        const auto room = std::min(place.file.rfind("shm/"), place.file.rfind("host/"));
        std::ifstream file(root_ + "/" + (room == std::string::npos ? place.file : place.file.substr(room)));
        std::string line;
        for (std::uint32_t i = 0; i < place.line; ++i) std::getline(file, line);
        line.erase(0, line.find_first_not_of(' '));
        return line;
    }
    static const Spared* find(const std::vector<Spared>& spared, const Mutation& mutation,
                              const std::string& line) {
        for (const auto& one : spared)
            if (mutation.damage == one.damage && (!one.order || *one.order == mutation.order) &&
                mutation.place.file.ends_with(one.file) &&
                (one.text[0] == '^' ? line.starts_with(one.text + 1)
                                    : line.find(one.text) != std::string::npos))
                return &one;
        return nullptr;
    }

    std::string root_;
    std::vector<Case> cases_;
    std::size_t random_, searched_;
};

} // namespace tandem::shm::model
