// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/remote/remote_rtc.hpp"

#include "host/log/log.hpp"
#include "host/process/start_thread.hpp"
#include "proxy/interceptor/engine/manager.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace tandem::interceptor {
namespace {

using namespace std::chrono_literals;

constexpr CORBA::ULong call_timeout_ms = 1000;
constexpr auto look_interval = 500ms, look_again_interval = 100ms, pause_between_states = 5ms;
// A connection may break once, for instance because the other side has closed an idle one.
constexpr int failed_looks_until_gone = 2;
constexpr int activation_attempts = 3;
constexpr CORBA::ULong max_ports = 1024; // the other process is not trusted

void limit_calls(CORBA::Object_ptr object) { omniORB::setClientCallTimeout(object, call_timeout_ms); }

/// rtcname://HOST/Name0 is that name in any context, as OpenRTM writes rtcname://HOST/*/Name0.
std::string with_context(const std::string& name) {
    constexpr std::string_view scheme = "rtcname://";
    if (!name.starts_with(scheme)) return name;
    const auto slash = name.find('/', scheme.size());
    if (slash == std::string::npos || name.find('/', slash + 1) != std::string::npos) return name;
    return name.substr(0, slash + 1) + "*/" + instance_of(name);
}

bool are_same(const RTC::PortServiceList& before, const RTC::PortServiceList& now) {
    if (before.length() != now.length()) return false;
    for (CORBA::ULong i = 0; i < now.length(); ++i)
        if (!before[i]->_is_equivalent(now[i])) return false;
    return true;
}

} // namespace

bool is_remote_name(const std::string& name) { return name.find("://") != std::string::npos; }

std::string instance_of(const std::string& name) {
    std::string instance = name.substr(name.rfind('/') + 1);
    if (instance.ends_with(".rtc")) instance.resize(instance.size() - 4);
    return instance;
}

/// The RTC from one start to its end.
struct RemoteRtc::Found {
    Found(const std::string& its_name, RTC::RTObject_ptr reference, RTC::ExecutionContext_ptr own,
          std::chrono::milliseconds timeout)
        : name(its_name), rtc(RTC::RTObject::_duplicate(reference)),
          context(RTC::ExecutionContext::_duplicate(own)),
          transitions(its_name, reference, own, timeout, pause_between_states) {}

    const std::string name;
    RTC::RTObject_var rtc;
    RTC::ExecutionContext_var context;
    RtcTransitions transitions;
    RTC::PortServiceList ports;
    RTC::LifeCycleState last_state = RTC::INACTIVE_STATE;

    RTC::LifeCycleState state() const { return context.in()->get_component_state(rtc.in()); }
    /// Throws CORBA::Exception, and std::runtime_error if there are too many.
    RTC::PortServiceList get_ports() const {
        RTC::PortServiceList_var now = rtc->get_ports();
        if (now->length() > max_ports)
            throw std::runtime_error(
                fmt::format("RTC {} has {} ports, at most {} are shared", name, now->length(), max_ports));
        for (CORBA::ULong i = 0; i < now->length(); ++i) limit_calls(now[i]);
        return now.in();
    }
};

RemoteRtc::RemoteRtc(RTC::Manager& manager, std::string owner, std::string name,
                     std::chrono::milliseconds timeout, Events events)
    : manager_(manager), owner_(std::move(owner)), name_(std::move(name)), timeout_(timeout),
      events_(std::move(events)) {
    publish_absence();
}

/// The caller holds mutex_, or is the constructor.
void RemoteRtc::publish_absence() {
    missing_.emplace(process::NoticeKind::component, owner_ + ": RTC " + name_ + " is not available");
}

RemoteRtc::~RemoteRtc() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    wake_.notify_all();
    if (thread_.joinable()) thread_.join();
    // The end of this host does not end the other one.
    if (!is_driven_) return;
    if (const std::string error = deactivate(); !error.empty()) log::error("{}: {}", owner_, error);
}

std::shared_ptr<RemoteRtc::Found> RemoteRtc::current() const {
    const std::lock_guard lock(mutex_);
    return found_;
}

RTC::PortServiceList RemoteRtc::find(std::string& reason) {
    reason = search();
    last_line_ = reason; // the caller logs it
    const auto rtc = current();
    return rtc ? rtc->ports : RTC::PortServiceList();
}

void RemoteRtc::watch() {
    thread_ = process::start_thread([this] { run(); });
}

void RemoteRtc::resume() {
    {
        const std::lock_guard lock(mutex_);
        resume_asked_ = ports_connected_ = true;
    }
    wake_.notify_all();
}

/// Returns why the RTC is not available, or an empty string.
std::string RemoteRtc::search() {
    std::string reason;
    const RTC::RTCList list = engine::find_by_name(manager_, with_context(name_), reason, call_timeout_ms);
    if (list.length() == 0) return reason;
    try {
        limit_calls(list[0]);
        const RTC::ExecutionContextList_var contexts = list[0]->get_owned_contexts();
        const RTC::ExecutionContext_var context = own_context(name_, contexts.in());
        limit_calls(context.in());
        const auto now = std::make_shared<Found>(name_, list[0], context.in(), timeout_);
        now->ports = now->get_ports();
        now->last_state = now->state();
        const std::lock_guard lock(mutex_);
        // A restarted RTC has not been activated yet. The same RTC may only have been unreachable.
        if (CORBA::is_nil(last_.in()) || !last_->_is_equivalent(now->rtc.in())) is_driven_ = false;
        last_ = now->rtc;
        found_ = now;
        missing_.reset();
        ports_connected_ = false;
    } catch (const std::runtime_error& error) {
        return error.what();
    } catch (const CORBA::Exception& error) { // it ends at this moment, or hangs
        return fmt::format("{}: it answers with CORBA exception {}", name_, error._name());
    }
    failed_looks_ = 0;
    return "";
}

void RemoteRtc::run() {
    for (;;) {
        {
            std::unique_lock lock(mutex_);
            const auto interval = failed_looks_ > 0 && found_ ? look_again_interval : look_interval;
            wake_.wait_for(lock, interval, [this] { return stopping_ || resume_asked_; });
            if (stopping_) return;
            resume_asked_ = false;
        }
        try {
            look();
        } catch (const CORBA::Exception& error) { // a port that was removed during the query
            say_once(fmt::format("{}: it answers with CORBA exception {}", name_, error._name()));
        } catch (const std::runtime_error& error) {
            say_once(error.what());
        }
    }
}

void RemoteRtc::look() {
    if (const auto rtc = current()) return look_at(*rtc);
    const std::string reason = search();
    if (!reason.empty()) return say_once(reason);
    last_line_.clear();
    log::info("{}: RTC {} is available", owner_, name_);
    try {
        events_.ports_changed(current()->ports);
    } catch (...) {
        const std::lock_guard lock(mutex_);
        found_.reset(); // it is found again
        throw;
    }
}

void RemoteRtc::look_at(Found& rtc) {
    try {
        const auto state = rtc.state();
        const auto ports = rtc.get_ports();
        failed_looks_ = 0;
        if (!last_line_.empty()) log::info("{}: RTC {} answers again", owner_, name_);
        last_line_.clear();
        if (state == RTC::ERROR_STATE && rtc.last_state != RTC::ERROR_STATE) {
            {
                const std::lock_guard lock(mutex_);
                wanted_active_ = is_driven_ = false;
            }
            events_.failed("went to ERROR");
        }
        if (state == RTC::ACTIVE_STATE && rtc.last_state != RTC::ACTIVE_STATE) events_.active();
        if (state == RTC::INACTIVE_STATE && rtc.last_state == RTC::ACTIVE_STATE) report_deactivation();
        rtc.last_state = state;
        if (!are_same(rtc.ports, ports)) {
            events_.ports_changed(ports);
            rtc.ports = ports;
        }
    } catch (const CORBA::TIMEOUT&) {
        // The process may be stopped, in a debugger, or behind a bad network. It is late, not dead.
        return say_once(fmt::format("RTC {} does not answer; its ports stay connected", name_));
    } catch (const CORBA::OBJECT_NOT_EXIST&) {
        return lose("has exited");
    } catch (const CORBA::SystemException&) {
        if (++failed_looks_ >= failed_looks_until_gone) lose("has gone with its process");
        return;
    }
    do_as_wanted(rtc);
}

void RemoteRtc::report_deactivation() {
    {
        const std::lock_guard lock(mutex_);
        if (!wanted_active_ || stopping_) return;
    }
    log::warn("{}: RTC {} was deactivated, but not by the link: it neither sends nor receives until it is "
              "activated",
              owner_, name_);
}

void RemoteRtc::lose(const char* why) {
    log::warn("{}: RTC {} {}; the search continues until it is back", owner_, name_, why);
    {
        const std::lock_guard lock(mutex_);
        found_.reset();
        publish_absence();
        ports_connected_ = false;
    }
    events_.gone();
}

/// Activates or deactivates it if that could not be done when the link asked for it.
void RemoteRtc::do_as_wanted(Found& rtc) {
    const std::lock_guard one_at_a_time(drive_mutex_);
    bool wanted = false, driven = false;
    {
        const std::lock_guard lock(mutex_);
        if (!ports_connected_) return;
        wanted = wanted_active_;
        driven = is_driven_;
        if (wanted == driven) return;
    }
    std::string error;
    if (!wanted) {
        error = rtc.transitions.deactivate();
        if (error.empty() && rtc.state() != RTC::ACTIVE_STATE) {
            log::info("{}: RTC {} is deactivated, as requested while it did not answer", owner_, name_);
            const std::lock_guard lock(mutex_);
            is_driven_ = false;
        }
        return;
    }
    for (int attempt = 0; attempt < activation_attempts; ++attempt) {
        error = rtc.transitions.activate();
        if (error.empty()) break;
        {
            const std::lock_guard lock(mutex_);
            if (stopping_ || !wanted_active_) return;
        }
    }
    {
        const std::lock_guard lock(mutex_);
        (error.empty() ? is_driven_ : wanted_active_) = error.empty();
    }
    if (!error.empty()) return events_.failed("cannot be activated again: " + error);
    log::info("{}: RTC {} is active again, as the link requires", owner_, name_);
}

bool RemoteRtc::has_gone(const std::shared_ptr<Found>& rtc) const {
    if (!rtc) return true;
    try {
        rtc->state();
        return false;
    } catch (const CORBA::TIMEOUT&) {
        return false;
    } catch (const CORBA::SystemException&) {
        return true;
    }
}

std::string RemoteRtc::activate() {
    {
        const std::lock_guard lock(mutex_);
        wanted_active_ = true;
    }
    const std::lock_guard one_at_a_time(drive_mutex_);
    const auto rtc = current();
    std::string error = rtc ? rtc->transitions.activate() : "";
    if (has_gone(rtc)) {
        log::warn("{}: RTC {} is not available; it will be activated when it appears", owner_, name_);
        return "";
    }
    const std::lock_guard lock(mutex_);
    (error.empty() ? is_driven_ : wanted_active_) = error.empty();
    return error;
}

std::string RemoteRtc::deactivate() {
    {
        const std::lock_guard lock(mutex_);
        wanted_active_ = false;
    }
    const std::lock_guard one_at_a_time(drive_mutex_);
    const auto rtc = current();
    if (has_gone(rtc)) return "";
    std::string error = rtc->transitions.deactivate();
    if (!error.empty()) return error;
    try {
        if (rtc->state() == RTC::ACTIVE_STATE) return fmt::format("{} is ACTIVE again", name_);
    } catch (const CORBA::SystemException&) {
        return fmt::format("{} does not answer; it is deactivated as soon as it does", name_);
    }
    const std::lock_guard lock(mutex_);
    is_driven_ = false;
    return "";
}

std::string RemoteRtc::reset() {
    const std::lock_guard one_at_a_time(drive_mutex_);
    const auto rtc = current();
    return has_gone(rtc) ? "" : rtc->transitions.reset();
}

bool RemoteRtc::is_active() const {
    const auto rtc = current();
    return rtc && rtc->transitions.state() == RTC::ACTIVE_STATE;
}

void RemoteRtc::say_once(const std::string& line) {
    if (line.empty() || line == last_line_) return;
    last_line_ = line;
    log::warn("{}: {}", owner_, line);
}

} // namespace tandem::interceptor
