// SPDX-License-Identifier: Apache-2.0
// Components and a manager that answer as those of OpenRTM-aist 2.1 do, where its answers differ from rtm_host's.
#include "openrtm_components.hpp"
#include "components.hpp"
#include "host/rtm/runtime/sdo/sdo_configuration.hpp"
#include <cstdio>
#include <cstdlib>
#include <rtm/ManagerServant.h>

namespace {

using namespace testing;

/// OpenRTM-aist 2.x releases each reference that get_components_by_name() returns once too often: after ten
/// calls its process ends. This process ends at the first call.
class FragileManager : public RTM::ManagerServant {
  public:
    using ManagerServant::ManagerServant;
    RTC::RTCList* get_components_by_name(const char*) override { std::_Exit(139); }
};

/// Publishes a FragileManager as the manager of its process, which has no other one (manager.corba_servant:
/// NO).
class FragileHost : public Counter {
  public:
    explicit FragileHost(RTC::Manager* manager) : Counter(manager), servant_(new FragileManager(*manager)) {
        if (!CORBA::is_nil(RTM::Manager_var(manager->getManagerServant().getObjRef()).in())) return;
        CORBA::Object_var object = manager->theORB()->resolve_initial_references("omniINSPOA");
        PortableServer::POA_var poa = PortableServer::POA::_narrow(object.in());
        PortableServer::ObjectId_var id = PortableServer::string_to_ObjectId("manager");
        poa->activate_object_with_id(id.in(), servant_.in());
        PortableServer::POAManager_var(poa->the_POAManager())->activate();
    }

  private:
    PortableServer::Servant_var<FragileManager> servant_;
};

/// A component whose execution context has a profile that does not show that its host is Tandem's.
template <class Base>
class InForeignHost : public Base {
  public:
    using Base::Base;
    RTC::ExecutionContextList* get_owned_contexts() override { return new RTC::ExecutionContextList; }
    RTC::ExecutionContextList* get_participating_contexts() override { return Base::get_owned_contexts(); }
};

/// Drops the first connection of its port without telling the other side, as OpenRTM-aist's ports do after a call that has failed.
class Dropper : public Counter {
  public:
    using Counter::Counter;
    RTC::ReturnCode_t onExecute(RTC::UniqueId id) override {
        if (!has_dropped_) {
            RTC::ConnectorProfileList_var present = out_.get_connector_profiles();
            if (present->length() == 0) return RTC::RTC_OK;
            out_.notify_disconnect(
                present[0].connector_id); // tells only the ports behind this one: there is none
            has_dropped_ = true;
        }
        return Counter::onExecute(id);
    }

  private:
    bool has_dropped_ = false;
};

/// Goes to its error state in its first cycle.
class FailingCounter : public Counter {
  public:
    using Counter::Counter;
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override { return RTC::RTC_ERROR; }
};

/// Behaves like OpenRTM-aist: after values were set, no set is active until one is activated.
class OpenRtmConfiguration : public SDOPackage::Configuration_impl {
  public:
    using Configuration_impl::Configuration_impl;
    CORBA::Boolean set_configuration_set_values(const SDOPackage::ConfigurationSet& set) override {
        has_active_set_ = false;
        return Configuration_impl::set_configuration_set_values(set);
    }
    SDOPackage::ConfigurationSet* get_active_configuration_set() override {
        if (!has_active_set_) throw SDOPackage::NotAvailable("");
        return Configuration_impl::get_active_configuration_set();
    }
    CORBA::Boolean activate_configuration_set(const char* id) override {
        const CORBA::Boolean activated = Configuration_impl::activate_configuration_set(id);
        has_active_set_ = true;
        return activated;
    }
    bool has_active_set() const { return has_active_set_; }

  private:
    std::atomic<bool> has_active_set_{true};
};

/// Uses `step` only from an active set, and prints the value that it uses: `uses step N`. Its sets are default and other; that
/// `size` is an int is said by a set of its own, as RTCBuilder writes it.
class ConfigurationUser : public RTC::DataFlowComponentBase {
  public:
    explicit ConfigurationUser(RTC::Manager* manager)
        : DataFlowComponentBase(manager),
          configuration_(new OpenRtmConfiguration(*this, getConfigService(),
                                                  std::make_shared<SDOPackage::Organizations>())) {}
    RTC::ReturnCode_t onInitialize() override {
        bindParameter("step", step_, "1");
        coil::Properties other("other");
        other.setProperty("step", "7");
        getConfigService().addConfigurationSet(other);
        bindParameter("level", level_, "2"); // any text, as those hosts accept it for numbers too
        bindParameter("size", size_, "3");
        coil::Properties types("__type__");
        types.setProperty("size", "int");
        getConfigService().addConfigurationSet(types);
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        if (!configuration_->has_active_set() || used_ == step_) return RTC::RTC_OK;
        used_ = step_;
        std::printf("uses step %d\n", used_);
        std::fflush(stdout);
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onFinalize() override {
        configuration_->retire();
        return RTC::RTC_OK;
    }
    SDOPackage::Configuration_ptr get_configuration() override { return configuration_->_this(); }

  private:
    int step_ = 0, used_ = 0, size_ = 0;
    std::string level_;
    PortableServer::Servant_var<OpenRtmConfiguration> configuration_;
};

} // namespace

void register_openrtm_components(RTC::Manager& manager) {
    register_component_type<FragileHost>(manager, "FragileHost");
    register_component_type<FailingCounter>(manager, "FailingCounter");
    register_component_type<Dropper>(manager, "Dropper");
    register_component_type<InForeignHost<ConfigurationUser>>(manager, "ConfigurationUser");
    register_component_type<InForeignHost<Accumulator>>(manager, "ForeignReader");
}
