// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/adaptor/data/mirror_in_port.hpp"
#include "proxy/adaptor/event/mirror_event_in_port.hpp"

#include <IDataPortLink.h>
#include <IEventPortLink.h>
#include <OutputDataPortInterface.h>
#include <OutputEventPortInterface.h>

namespace tandem::adaptor {

/// A connection from an output data or event port of a shared component to a channel of the link; lives as long as this
/// object. Encodes what the component sends in the component's thread. `Ends` is DataEnds or EventEnds.
template <class Ends>
class OutConnection final : public Ends::Link {
  public:
    using Source = typename Ends::Source;
    using Value = typename Ends::Value;
    using Port = typename Ends::Port;
    using Remote = typename Ends::Remote;

    OutConnection(Source& source, const link::Port& port, link::ChannelWriter& channel)
        : source_(source), mirror_(port, channel) {
        // The table was made from the same type: this only tells the mirror about it.
        Ends::show_type(source, mirror_);
        source_.addConnection(this);
    }
    ~OutConnection() override { source_.removeConnection(this); }
    OutConnection(const OutConnection&) = delete;
    OutConnection& operator=(const OutConnection&) = delete;

    ReturnType push(Value value) override { return mirror_.push(value); }
    ReturnType setSource(Port*) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType addDestination(Port*) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType addDestination(Remote*) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType removeDestination(Port*) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType removeDestination(Remote*) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType clearDestination() override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType clearSource() override { return OPROS_UNSUPPORTED_METHOD; }

  private:
    Source& source_;
    typename Ends::Mirror mirror_;
};

struct DataEnds {
    class Link : public IDataPortLink, public rt::Rehearsable {};
    using Source = OutputDataPortInterface;
    using Value = opros_any&;
    using Port = DataPort;
    using Remote = RemoteDataPort;
    using Mirror = MirrorInPort;
    static void show_type(Source& source, Mirror& mirror) {
        opros_any sample = source.sample();
        mirror.checkType(sample);
    }
};

struct EventEnds {
    using Link = IEventPortLink;
    using Source = OutputEventPortInterface;
    using Value = Event*;
    using Port = EventPort;
    using Remote = RemoteEventPort;
    using Mirror = MirrorEventInPort;
    static void show_type(Source& source, Mirror& mirror) { mirror.checkType(&source); }
};

} // namespace tandem::adaptor
