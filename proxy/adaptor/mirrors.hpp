// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/adaptor/event/mirror_event_in_port.hpp"
#include "proxy/adaptor/event/mirror_fsm_port.hpp"

#ifdef TANDEM_OPROS_PUBLIC_API
#include "proxy/adaptor/typed/no_shared_components.hpp"
#include "proxy/adaptor/typed/typed_event_out_port.hpp"
#include "proxy/adaptor/typed/typed_in_port.hpp"
#include "proxy/adaptor/typed/typed_out_port.hpp"
#include "proxy/adaptor/typed/typed_provided_port.hpp"
#include "proxy/adaptor/typed/typed_required_port.hpp"
#else
#include "proxy/adaptor/data/mirror_in_port.hpp"
#include "proxy/adaptor/data/mirror_out_port.hpp"
#include "proxy/adaptor/event/mirror_event_out_port.hpp"
#include "proxy/adaptor/service/mirror_provided_port.hpp"
#include "proxy/adaptor/service/mirror_required_port.hpp"
#include "proxy/adaptor/share/shared_components.hpp"
#endif

namespace tandem::adaptor::engine {

// The mirrors of the peer's ports, and the components that are shared with the peer. In a real engine a port carries only
// the name of its type, and a method no type at all. The mirrors there know a list of C++ types (typed/).
using EventInPort = MirrorEventInPort;
using FsmPort = MirrorFsmPort;
#ifdef TANDEM_OPROS_PUBLIC_API
using InPort = TypedInPort;
using OutPort = TypedOutPort;
using EventOutPort = TypedEventOutPort;
using ProvidedPort = TypedProvidedPort;
using RequiredPort = TypedRequiredPort;
using SharedComponents = NoSharedComponents;
#else
using InPort = MirrorInPort;
using OutPort = MirrorOutPort;
using EventOutPort = MirrorEventOutPort;
using ProvidedPort = MirrorProvidedPort;
using RequiredPort = MirrorRequiredPort;
using adaptor::SharedComponents;
#endif

} // namespace tandem::adaptor::engine
