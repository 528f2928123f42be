// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/drive/rtc_group.hpp"

#include "proxy/link/protocol/control.hpp"

#include <algorithm>
#include <chrono>

namespace tandem::interceptor {

// The threads first: what they still execute may be a transition of any of these RTCs.
RtcGroup::~RtcGroup() { stop(); }

void RtcGroup::stop() {
    for (auto& member : members_) member.thread->stop();
}

void RtcGroup::add(std::unique_ptr<DrivenRtc> rtc) {
    auto thread = std::make_unique<link::TaskQueue>(link_);
    rtc->set_thread(*thread);
    thread->start();
    members_.push_back({std::move(thread), std::move(rtc)});
}

/// Waits for its end, but not longer than the head start.
RtcGroup::Begun RtcGroup::begin(Member& member, Transition transition) {
    auto task = std::make_shared<std::packaged_task<Outcome()>>(
        [transition = std::move(transition), rtc = member.rtc.get()] { return transition(*rtc); });
    Begun begun{&member, task->get_future().share()};
    member.thread->post([task] { (*task)(); });
    begun.outcome.wait_for(link::control::head_start);
    return begun;
}

std::string RtcGroup::first_error(const std::vector<Begun>& begun) {
    std::string first;
    for (const auto& each : begun) {
        const auto& error = each.outcome.get().error;
        if (first.empty()) first = error;
    }
    return first;
}

std::string RtcGroup::activate() {
    const auto has_failed = [](const Begun& begun) {
        return begun.outcome.wait_for(std::chrono::seconds(0)) == std::future_status::ready &&
               !begun.outcome.get().error.empty();
    };
    std::vector<Begun> begun;
    for (auto& member : members_) {
        begun.push_back(begin(member, [](DrivenRtc& rtc) {
            const bool was_active = rtc.is_active();
            std::string error = rtc.activate();
            const bool activated = error.empty() && !was_active;
            return Outcome{std::move(error), activated};
        }));
        if (has_failed(begun.back())) break; // the RTCs after it were not activated
    }
    std::string error = first_error(begun);
    if (error.empty()) return error;
    std::vector<Begun> taken_back;
    for (auto each = begun.rbegin(); each != begun.rend(); ++each)
        if (each->outcome.get().activated)
            taken_back.push_back(
                begin(*each->member, [](DrivenRtc& rtc) { return Outcome{rtc.deactivate()}; }));
    first_error(taken_back); // the user needs the original error, not this one
    return error;
}

std::string RtcGroup::deactivate() {
    std::vector<Begun> begun;
    for (auto member = members_.rbegin(); member != members_.rend(); ++member)
        begun.push_back(begin(*member, [](DrivenRtc& rtc) { return Outcome{rtc.deactivate()}; }));
    return first_error(begun);
}

void RtcGroup::begin_deactivation(const std::function<void(const std::string& error)>& on_error) {
    for (auto member = members_.rbegin(); member != members_.rend(); ++member)
        begin(*member, [on_error](DrivenRtc& rtc) {
            Outcome outcome{rtc.deactivate()};
            if (!outcome.error.empty()) on_error(outcome.error);
            return outcome;
        });
}

bool RtcGroup::are_all_active() const {
    return std::ranges::all_of(members_, [](const Member& member) { return member.rtc->is_active(); });
}

std::string RtcGroup::reset() {
    std::vector<Begun> begun;
    for (auto& member : members_)
        begun.push_back(begin(member, [](DrivenRtc& rtc) { return Outcome{rtc.reset()}; }));
    return first_error(begun);
}

} // namespace tandem::interceptor
