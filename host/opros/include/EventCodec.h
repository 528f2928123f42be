// SPDX-License-Identifier: Apache-2.0
// Encodes events for the two typed event ports. Ours.
#ifndef EVENTCODEC_H_
#define EVENTCODEC_H_

#include <ArchiveFactory.h>
#include <EncodedPush.h>
#include <EventData.h>

namespace opros {
namespace detail {

/// Encodes and decodes events with content of type T.
template <typename T, bool serializable = archive::is_serializable<T>::value>
struct event_codec {
    /// Decodes an event and pushes it into the port. Throws the exceptions of the archive.
    template <typename Port>
    static ReturnType push(Port& port, archive::iarchive& in) {
        EventData<T> event;
        in >> event;
        return port.push(&event);
    }
    /// Encodes the event, which must be an EventData<T>.
    static ReturnType marshal(ArchiveFactory& factory, Event* event, std::string& bytes) {
        std::stringstream stream;
        archive::oarchive* archive = factory.getOutputArchive(&stream);
        (*archive) << *static_cast<EventData<T>*>(event);
        factory.release(archive);
        bytes = stream.str();
        return OPROS_SUCCESS;
    }
};
/// For content that cannot be archived: such events stay inside this host.
template <typename T>
struct event_codec<T, false> {
    template <typename Port>
    static ReturnType push(Port&, archive::iarchive&) {
        return OPROS_UNSUPPORTED_METHOD;
    }
    static ReturnType marshal(ArchiveFactory&, Event*, std::string&) { return OPROS_UNSUPPORTED_METHOD; }
};

} // namespace detail
} // namespace opros

#endif
