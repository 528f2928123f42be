// SPDX-License-Identifier: Apache-2.0
// Listeners to the manager's actions: shutdown, loading of modules, creation and naming of components. They run in
// the thread that causes the action.
#ifndef RTM_MANAGERACTIONLISTENER_H
#define RTM_MANAGERACTIONLISTENER_H
#include <coil/Properties.h>
#include <coil/stringutil.h>
#include <rtm/ListenerHolder.h>
#include <string>

namespace RTC {
class RTObject_impl;
}

namespace RTM {

class ManagerActionListener {
  public:
    virtual ~ManagerActionListener() = default;
    virtual void preShutdown() = 0;
    virtual void postShutdown() = 0;
    virtual void preReinit() = 0;
    virtual void postReinit() = 0;
};
class ModuleActionListener {
  public:
    virtual ~ModuleActionListener() = default;
    virtual void preLoad(std::string& modname, std::string& funcname) = 0;
    virtual void postLoad(std::string& modname, std::string& funcname) = 0;
    virtual void preUnload(std::string& modname) = 0;
    virtual void postUnload(std::string& modname) = 0;
};
class RtcLifecycleActionListener {
  public:
    virtual ~RtcLifecycleActionListener() = default;
    virtual void preCreate(std::string& args) = 0;
    virtual void postCreate(RTC::RTObject_impl*) = 0;
    virtual void preConfigure(coil::Properties& prop) = 0;
    virtual void postConfigure(coil::Properties& prop) = 0;
    virtual void preInitialize() = 0;
    virtual void postInitialize() = 0;
};
class NamingActionListener {
  public:
    virtual ~NamingActionListener() = default;
    virtual void preBind(RTC::RTObject_impl* rtobj, coil::vstring& name) = 0;
    virtual void postBind(RTC::RTObject_impl* rtobj, coil::vstring& name) = 0;
    virtual void preUnbind(RTC::RTObject_impl* rtobj, coil::vstring& name) = 0;
    virtual void postUnbind(RTC::RTObject_impl* rtobj, coil::vstring& name) = 0;
};

} // namespace RTM

extern template class RTM::util::ListenerHolder<RTM::ManagerActionListener>;
extern template class RTM::util::ListenerHolder<RTM::ModuleActionListener>;
extern template class RTM::util::ListenerHolder<RTM::RtcLifecycleActionListener>;
extern template class RTM::util::ListenerHolder<RTM::NamingActionListener>;

namespace RTM {

struct ManagerActionListeners {
    util::ListenerHolder<ManagerActionListener> manager_;
    util::ListenerHolder<ModuleActionListener> module_;
    util::ListenerHolder<RtcLifecycleActionListener> rtclifecycle_;
    util::ListenerHolder<NamingActionListener> naming_;
};

} // namespace RTM
#endif
