// SPDX-License-Identifier: Apache-2.0
// What an execution context calls: the component's callbacks, and what comes before and after each.
#include <rtm/RTObject.h>

namespace RTC {

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

// Nothing a component throws may end its host: the reason is logged, and the state machine sees an error.
template <class Callback>
ReturnCode_t RTObject_impl::guarded(const char* what, UniqueId ec_id, PreComponentActionListenerType pre,
                                    PostComponentActionListenerType post, Callback callback) {
    ReturnCode_t result = RTC_ERROR;
    try {
        m_actionListeners.preaction_[m_actionListeners.at(pre)].forEach(
            [&](auto& listener) { listener(ec_id); });
        result = callback();
        if (result != RTC_OK)
            RTC_ERROR(("%s: %s returned %d", getInstanceName(), what, static_cast<int>(result)));
    } catch (const std::exception& e) {
        RTC_ERROR(("%s: %s threw: %s", getInstanceName(), what, e.what()));
    } catch (const CORBA::Exception& e) {
        RTC_ERROR(("%s: %s threw CORBA exception %s", getInstanceName(), what, e._name()));
    } catch (...) {
        RTC_ERROR(("%s: %s threw something that is not a std::exception", getInstanceName(), what));
    }
    m_actionListeners.postaction_[m_actionListeners.at(post)].forEach(
        [&](auto& listener) { listener(ec_id, result); });
    return result;
}

#define TANDEM_GUARDED(ACTION, callback)                                                                     \
    guarded(#callback, ec_id, PreComponentActionListenerType::PRE_ON_##ACTION,                                     \
            PostComponentActionListenerType::POST_ON_##ACTION, [&]() -> ReturnCode_t

ReturnCode_t RTObject_impl::on_initialize() {
    const UniqueId ec_id = 0;
    const ReturnCode_t result = TANDEM_GUARDED(INITIALIZE, onInitialize) { return onInitialize(); });
    const std::string wanted = m_properties.getProperty("configuration.active_config", "default");
    const std::string set = m_configsets.haveConfig(wanted.c_str()) ? wanted : "default";
    m_configsets.activateConfigurationSet(set.c_str());
    m_configsets.update(set.c_str());
    return result;
}

ReturnCode_t RTObject_impl::on_finalize() {
    const UniqueId ec_id = 0;
    return TANDEM_GUARDED(FINALIZE, onFinalize) { return onFinalize(); });
}

ReturnCode_t RTObject_impl::on_startup(UniqueId ec_id) {
    return TANDEM_GUARDED(STARTUP, onStartup) { return onStartup(ec_id); });
}

ReturnCode_t RTObject_impl::on_shutdown(UniqueId ec_id) {
    return TANDEM_GUARDED(SHUTDOWN, onShutdown) { return onShutdown(ec_id); });
}

ReturnCode_t RTObject_impl::on_activated(UniqueId ec_id) {
    return TANDEM_GUARDED(ACTIVATED, onActivated) {
        m_configsets.update();
        const ReturnCode_t result = onActivated(ec_id);
        m_portAdmin.activatePorts();
        return result;
    });
}

ReturnCode_t RTObject_impl::on_deactivated(UniqueId ec_id) {
    return TANDEM_GUARDED(DEACTIVATED, onDeactivated) {
        m_portAdmin.deactivatePorts();
        return onDeactivated(ec_id);
    });
}

ReturnCode_t RTObject_impl::on_aborting(UniqueId ec_id) {
    return TANDEM_GUARDED(ABORTING, onAborting) { return onAborting(ec_id); });
}

ReturnCode_t RTObject_impl::on_error(UniqueId ec_id) {
    return TANDEM_GUARDED(ERROR, onError) {
        const ReturnCode_t result = onError(ec_id);
        m_configsets.update();
        return result;
    });
}

ReturnCode_t RTObject_impl::on_reset(UniqueId ec_id) {
    return TANDEM_GUARDED(RESET, onReset) { return onReset(ec_id); });
}

ReturnCode_t RTObject_impl::on_execute(UniqueId ec_id) {
    return TANDEM_GUARDED(EXECUTE, onExecute) {
        if (m_readAll) readAll();
        const ReturnCode_t result = onExecute(ec_id);
        if (m_writeAll) writeAll();
        return result;
    });
}

ReturnCode_t RTObject_impl::on_state_update(UniqueId ec_id) {
    return TANDEM_GUARDED(STATE_UPDATE, onStateUpdate) {
        const ReturnCode_t result = onStateUpdate(ec_id);
        m_configsets.update();
        return result;
    });
}

ReturnCode_t RTObject_impl::on_rate_changed(UniqueId ec_id) {
    return TANDEM_GUARDED(RATE_CHANGED, onRateChanged) { return onRateChanged(ec_id); });
}

bool RTObject_impl::readAll() {
    bool all = true;
    for (auto* port : m_inports) {
        if (port->read()) continue;
        all = false;
        if (!m_readAllCompletion) return false;
    }
    return all;
}

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
