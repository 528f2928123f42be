// SPDX-License-Identifier: Apache-2.0
// Encoded events, for the two typed event ports. Ours.
#ifndef EVENTCODEC_H_
#define EVENTCODEC_H_

#include <ArchiveFactory.h>
#include <EventData.h>

namespace opros {
namespace detail {

template <typename T, bool serializable = archive::is_serializable<T>::value>
struct event_codec {
    template <typename Port>
    static ReturnType push(Port& port, archive::iarchive& in) {
        EventData<T> event;
        in >> event;
        return port.push(&event);
    }
    static ReturnType marshal(ArchiveFactory& factory, Event* event, std::string& bytes) {
        std::stringstream stream;
        archive::oarchive* archive = factory.getOutputArchive(&stream);
        (*archive) << *static_cast<EventData<T>*>(event);
        factory.release(archive);
        bytes = stream.str();
        return OPROS_SUCCESS;
    }
};
template <typename T>
struct event_codec<T, false> {
    template <typename Port>
    static ReturnType push(Port&, archive::iarchive&) {
        return OPROS_UNSUPPORTED_METHOD;
    }
    static ReturnType marshal(ArchiveFactory&, Event*, std::string&) { return OPROS_UNSUPPORTED_METHOD; }
};

template <typename Port>
ReturnType push_encoded_event(Port& port, ArchiveFactory* factory, unsigned char* data, int size) {
    if (!factory) return OPROS_UNSUPPORTED_METHOD;
    std::stringstream bytes(std::string(reinterpret_cast<const char*>(data), static_cast<std::size_t>(size)));
    archive::iarchive* archive = factory->getInputArchive(&bytes);
    const ReturnType result = port.push(*archive);
    factory->release(archive);
    return result;
}

} // namespace detail
} // namespace opros

#endif
