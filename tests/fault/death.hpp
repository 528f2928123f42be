// SPDX-License-Identifier: Apache-2.0
// A process that dies at the k-th point of its work, and what must hold for the surviving process.
#pragma once
#include "../shm/fixture.hpp"
#include "crash_point_atomics.hpp"

#include <set>

namespace tandem::shm::test {

constexpr std::size_t arena = 64 * 1024; ///< of both sides

/// Joins a link as `side`, and from then on passes points: at the k-th it dies. Exits with 0 if it passes fewer points.
class Doomed {
  public:
    Doomed(const Link& link, Side side, unsigned k, const std::function<void(Segment&)>& work)
        : child_([&] {
              const auto segment = join(link, side, small(arena));
              Points::mine = &*points_;
              points_->countdown = k;
              work(*segment);
              points_->countdown = 0;
              return 0;
          }) {}

    bool ended() {
        if (!result_) result_ = child_.ended();
        return result_.has_value();
    }
    /// Returns whether the process died at a point, and false if it reached its end.
    bool died() {
        if (!result_) result_ = child_.wait();
        return *result_ == Child::killed;
    }
    /// Any value other than 0 is an error of the child: it neither died at a point nor ended successfully.
    int error() { return died() ? 0 : *result_; }
    std::string point() const { return points_->name; }

  private:
    Shared<Points> points_;
    std::optional<int> result_;
    Child child_;
};

/// The peer is dead. The link continues in the next generation, and nothing is left when all have left.
inline void check_that_the_link_goes_on(const Link& link, std::unique_ptr<Segment>& survivor) {
    const Side side = survivor->side();
    CHECK(survivor->peer_state() == PeerState::dead);
    const std::uint64_t before = survivor->generation();
    auto restarted = join(link, other(side));
    CHECK(restarted->generation() > before);
    CHECK(survivor->superseded());
    survivor.reset();
    survivor = join(link, side);
    CHECK(survivor->generation() == restarted->generation());
    CHECK(survivor->peer_state() == PeerState::alive);
    restarted.reset();
    survivor.reset();
    CHECK(link.files().empty());
}

/// The names of the points of one scenario, shown with TANDEM_POINTS set.
class PointNames {
  public:
    explicit PointNames(std::string scenario) : scenario_(std::move(scenario)) {}
    ~PointNames() {
        if (std::getenv("TANDEM_POINTS") == nullptr) return;
        std::printf("%s: %zu points at", scenario_.c_str(), count_);
        for (const auto& name : names_) std::printf(" %s", name.c_str());
        std::printf("\n");
    }
    void add(const std::string& name) { ++count_, names_.insert(name); }
    std::size_t count() const { return count_; }

  private:
    std::string scenario_;
    std::size_t count_ = 0;
    std::set<std::string> names_;
};

} // namespace tandem::shm::test
