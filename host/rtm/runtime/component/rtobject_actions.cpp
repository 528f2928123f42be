// SPDX-License-Identifier: Apache-2.0
// The actions that an execution context calls (on_...), and the user's callbacks (on...) within them.
// OpenRTM-aist: RTObject_impl::on_initialize() ... on_rate_changed(); the order of callback, ports and
// configuration in each action is the same.
#include "host/crash/callback_scope.hpp"
#include "host/rt/cycle_lines.hpp"
#include "host/rt/periodic_tick.hpp"
#include "host/rt/rehearsal.hpp"
#include "host/rtm/runtime/execution/callback_failure.hpp"
#include <atomic>
#include <iterator>
#include <rtm/RTObject.h>
#include <string>
#include <typeinfo>

namespace RTC {

using tandem::rt::rehearsing;

// Callbacks that a component does not override do nothing.
ReturnCode_t RTObject_impl::onInitialize() { return RTC_OK; }
ReturnCode_t RTObject_impl::onFinalize() { return RTC_OK; }
ReturnCode_t RTObject_impl::onStartup(UniqueId) { return RTC_OK; }
ReturnCode_t RTObject_impl::onShutdown(UniqueId) { return RTC_OK; }
ReturnCode_t RTObject_impl::onActivated(UniqueId) { return RTC_OK; }
ReturnCode_t RTObject_impl::onDeactivated(UniqueId) { return RTC_OK; }
ReturnCode_t RTObject_impl::onExecute(UniqueId) { return RTC_OK; }
ReturnCode_t RTObject_impl::onAborting(UniqueId) { return RTC_OK; }
ReturnCode_t RTObject_impl::onError(UniqueId) { return RTC_OK; }
ReturnCode_t RTObject_impl::onReset(UniqueId) { return RTC_OK; }
ReturnCode_t RTObject_impl::onStateUpdate(UniqueId) { return RTC_OK; }
ReturnCode_t RTObject_impl::onRateChanged(UniqueId) { return RTC_OK; }

// Returns for example `1 (RTC_ERROR)`. A component may return any number.
static std::string describe_code(ReturnCode_t code) {
    static constexpr const char* names[] = {"RTC_OK",      "RTC_ERROR",        "BAD_PARAMETER",
                                            "UNSUPPORTED", "OUT_OF_RESOURCES", "PRECONDITION_NOT_MET"};
    const auto number = static_cast<std::size_t>(code);
    return std::to_string(static_cast<int>(code)) +
           (number < std::size(names) ? std::string(" (") + names[number] + ")" : "");
}

// Runs one callback between its listeners. Logs every exception and turns it into RTC_ERROR for the state machine, so
// that a component cannot end its host. OpenRTM-aist catches the exception without a message.
template <class Callback>
ReturnCode_t RTObject_impl::run_guarded(const char* what, UniqueId ec_id, PreComponentActionListenerType pre,
                                        PostComponentActionListenerType post, Callback callback) {
    const tandem::crash::CallbackScope scope(this, getInstanceName(), what, &typeid(*this));
    ReturnCode_t result = RTC_ERROR;
    std::string error;
    auto attempt = [&](auto call) {
        try {
            call();
        } catch (const std::exception& e) {
            error = std::string("threw: ") + e.what();
        } catch (const CORBA::Exception& e) {
            error = std::string("threw CORBA exception ") + e._name();
        } catch (...) {
            error = "threw something that is not a std::exception";
        }
    };
    attempt([&] {
        m_actionListeners.preaction_[m_actionListeners.at(pre)].forEach([&](auto& listener) {
            if (!rehearsing()) listener(ec_id);
        });
        result = callback();
        if (result != RTC_OK) error = "returned " + describe_code(result);
    });
    // In the error state onError runs in each cycle, possibly in several contexts at once, and may fail each time. Its
    // failure is logged once per stay in that state.
    std::atomic_ref<bool> reported(m_errorReported);
    bool already_logged = false;
    if (pre == PreComponentActionListenerType::PRE_ON_ABORTING) reported = false;
    if (pre == PreComponentActionListenerType::PRE_ON_ERROR)
        already_logged = reported.exchange(!error.empty());
    const auto note_failure = [&](const std::string& why) {
        note_callback_failure(this, why);
        if (pre == PreComponentActionListenerType::PRE_ON_ACTIVATED ||
            pre == PreComponentActionListenerType::PRE_ON_EXECUTE ||
            pre == PreComponentActionListenerType::PRE_ON_STATE_UPDATE ||
            pre == PreComponentActionListenerType::PRE_ON_RESET)
            m_failedCallback = what;
    };
    if (!error.empty()) {
        note_failure(std::string(what) + " " + error);
        if (!already_logged) RTC_ERROR(("%s %s", what, error.c_str()));
        error.clear();
    }
    attempt([&] {
        m_actionListeners.postaction_[m_actionListeners.at(post)].forEach([&](auto& listener) {
            if (!rehearsing()) listener(ec_id, result);
        });
    });
    if (error.empty()) return result;
    note_failure(std::string("a listener after ") + what + " " + error);
    RTC_ERROR(("a listener after %s %s", what, error.c_str()));
    return RTC_ERROR;
}

using Pre = PreComponentActionListenerType;
using Post = PostComponentActionListenerType;

// The active configuration set is applied after onInitialize, which has bound the variables. Every component has one:
// tools restore a system by activating it, even if it has no parameters.
ReturnCode_t RTObject_impl::on_initialize() {
    return run_guarded("onInitialize", 0, Pre::PRE_ON_INITIALIZE, Post::POST_ON_INITIALIZE, [&] {
        const ReturnCode_t result = onInitialize();
        const std::string configured = m_properties.getProperty("configuration.active_config", "default");
        const std::string set = m_configsets.haveConfig(configured.c_str()) ? configured : "default";
        m_properties.getNode("conf." + set);
        m_configsets.activateConfigurationSet(set.c_str());
        m_configsets.update(set.c_str());
        return result;
    });
}

ReturnCode_t RTObject_impl::on_finalize() {
    return run_guarded("onFinalize", 0, Pre::PRE_ON_FINALIZE, Post::POST_ON_FINALIZE,
                       [&] { return onFinalize(); });
}

ReturnCode_t RTObject_impl::on_startup(UniqueId ec_id) {
    return run_guarded("onStartup", ec_id, Pre::PRE_ON_STARTUP, Post::POST_ON_STARTUP,
                       [&] { return onStartup(ec_id); });
}

ReturnCode_t RTObject_impl::on_shutdown(UniqueId ec_id) {
    return run_guarded("onShutdown", ec_id, Pre::PRE_ON_SHUTDOWN, Post::POST_ON_SHUTDOWN,
                       [&] { return onShutdown(ec_id); });
}

// Ports become active after onActivated has returned, whatever its result, as in OpenRTM-aist. Until then providers of
// services cannot be called.
ReturnCode_t RTObject_impl::on_activated(UniqueId ec_id) {
    m_failedCallback = nullptr;
    return run_guarded("onActivated", ec_id, Pre::PRE_ON_ACTIVATED, Post::POST_ON_ACTIVATED, [&] {
        m_configsets.update();
        const ReturnCode_t result = onActivated(ec_id);
        m_portAdmin.activatePorts();
        return result;
    });
}

// Ports become inactive before onDeactivated runs, so that no service is called any more.
ReturnCode_t RTObject_impl::on_deactivated(UniqueId ec_id) {
    return run_guarded("onDeactivated", ec_id, Pre::PRE_ON_DEACTIVATED, Post::POST_ON_DEACTIVATED, [&] {
        m_portAdmin.deactivatePorts();
        return onDeactivated(ec_id);
    });
}

ReturnCode_t RTObject_impl::on_aborting(UniqueId ec_id) {
    const char* const failed = m_failedCallback; // NULL if on_execute() itself is overridden
    if (failed != nullptr) {
        RTC_ERROR(("went to ERROR: its %s has failed", failed));
    } else {
        RTC_ERROR(("went to ERROR"));
    }
    return run_guarded("onAborting", ec_id, Pre::PRE_ON_ABORTING, Post::POST_ON_ABORTING,
                       [&] { return onAborting(ec_id); });
}

// Configuration changes also apply in the error state, because they may remove the cause.
ReturnCode_t RTObject_impl::on_error(UniqueId ec_id) {
    return run_guarded("onError", ec_id, Pre::PRE_ON_ERROR, Post::POST_ON_ERROR, [&] {
        const ReturnCode_t result = onError(ec_id);
        m_configsets.update();
        return result;
    });
}

ReturnCode_t RTObject_impl::on_reset(UniqueId ec_id) {
    return run_guarded("onReset", ec_id, Pre::PRE_ON_RESET, Post::POST_ON_RESET,
                       [&] { return onReset(ec_id); });
}

ReturnCode_t RTObject_impl::on_execute(UniqueId ec_id) {
    // What on_execute() and on_state_update() use of this object.
    const auto note_cycle_lines = [this] {
        using tandem::rt::note_lines;
        constexpr std::size_t holder_head = 16; // the members that ListenerHolder::forEach() looks at
        auto& [before, after, ports, contexts] = m_actionListeners;
        note_lines(dynamic_cast<const void*>(this), sizeof(void*));
        note_lines(&m_profile.instance_name, sizeof m_profile.instance_name);
        note_lines(&m_configsets, sizeof(bool));
        for (const auto execute = m_actionListeners.at(Pre::PRE_ON_EXECUTE);
             const auto i : {execute, execute + 1}) {
            note_lines(&before[i], holder_head);
            note_lines(&after[i], holder_head);
        }
        note_lines(&m_readAll, 4 * sizeof(bool));
    };
    return run_guarded("onExecute", ec_id, Pre::PRE_ON_EXECUTE, Post::POST_ON_EXECUTE, [&] {
        if (rehearsing()) {
            tandem::rt::prefetch(*this);
            note_cycle_lines();
            m_portAdmin.rehearsePorts();
            return RTC_OK;
        }
        if (m_readAll) readAll();
        const ReturnCode_t result = onExecute(ec_id);
        if (m_writeAll) writeAll();
        return result;
    });
}

// The place where a running component's configuration changes, after onExecute and onStateUpdate.
ReturnCode_t RTObject_impl::on_state_update(UniqueId ec_id) {
    return run_guarded("onStateUpdate", ec_id, Pre::PRE_ON_STATE_UPDATE, Post::POST_ON_STATE_UPDATE, [&] {
        const ReturnCode_t result = onStateUpdate(ec_id);
        m_configsets.update();
        return result;
    });
}

ReturnCode_t RTObject_impl::on_rate_changed(UniqueId ec_id) {
    return run_guarded("onRateChanged", ec_id, Pre::PRE_ON_RATE_CHANGED, Post::POST_ON_RATE_CHANGED,
                       [&] { return onRateChanged(ec_id); });
}

// Reads the InPorts. Stops at the first port that has nothing, unless `completion` was asked for.
bool RTObject_impl::readAll() {
    bool all = true;
    for (auto* port : m_inports) {
        if (port->read()) continue;
        all = false;
        if (!m_readAllCompletion) return false;
    }
    return all;
}

// Writes the OutPorts. Stops at the first port that fails, unless `completion` was asked for.
bool RTObject_impl::writeAll() {
    bool all = true;
    for (auto* port : m_outports) {
        if (port->write()) continue;
        all = false;
        if (!m_writeAllCompletion) return false;
    }
    return all;
}

void RTObject_impl::setReadAll(bool read, bool completion) {
    m_readAll = read;
    m_readAllCompletion = completion;
}
void RTObject_impl::setWriteAll(bool write, bool completion) {
    m_writeAll = write;
    m_writeAllCompletion = completion;
}

} // namespace RTC
