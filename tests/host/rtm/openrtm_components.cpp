// SPDX-License-Identifier: Apache-2.0
// Components and a manager that answer as those of OpenRTM-aist 2.1 do, where its answers differ from rtm_host's.
#include "openrtm_components.hpp"
#include "components.hpp"
#include <cstdio>
#include <cstdlib>
#include <rtm/ManagerServant.h>

namespace {

using namespace testing;

/// OpenRTM-aist 2.x releases each reference that get_components_by_name() returns once too often: after ten
/// calls its process ends. This one ends at the first.
class FragileManager : public RTM::ManagerServant {
  public:
    using ManagerServant::ManagerServant;
    RTC::RTCList* get_components_by_name(const char*) override { std::_Exit(139); }
};

/// Publishes a FragileManager as the manager of its process if that has none (manager.corba_servant: NO).
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

} // namespace

void register_openrtm_components(RTC::Manager& manager) {
    register_component_type<FragileHost>(manager, "FragileHost");
}
