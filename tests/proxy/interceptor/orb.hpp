// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <omniORB4/CORBA.h>

namespace tandem::interceptor {

/// An ORB for one test case. Without one omniORB has no code set, and marshalling a string crashes.
struct Orb {
    CORBA::ORB_var orb;
    PortableServer::POA_var poa;
    Orb() {
        const char* options[][2] = {{"endPoint", "giop:tcp:127.0.0.1:"}, {nullptr, nullptr}};
        int argc = 0;
        orb = CORBA::ORB_init(argc, nullptr, "omniORB4", options);
        CORBA::Object_var root = orb->resolve_initial_references("RootPOA");
        poa = PortableServer::POA::_narrow(root);
        PortableServer::POAManager_var manager = poa->the_POAManager();
        manager->activate();
    }
    ~Orb() { orb->destroy(); }
};

} // namespace tandem::interceptor
