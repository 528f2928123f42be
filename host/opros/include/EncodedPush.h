// SPDX-License-Identifier: Apache-2.0
// Pushes encoded values and events, for the four typed ports. Ours.
#ifndef ENCODEDPUSH_H_
#define ENCODEDPUSH_H_

#include <ArchiveFactory.h>
#include <OPRoSTypes.h>
#include <ReturnType.h>

#include <sstream>
#include <string>

namespace opros {
namespace detail {

/// Implements pushData() and pushEvent(): pushes the archive from which the bytes are read.
template <typename Port>
ReturnType push_encoded(Port& port, ArchiveFactory* factory, unsigned char* data, int size) {
    if (!factory) return OPROS_UNSUPPORTED_METHOD;
    std::stringstream bytes(std::string(reinterpret_cast<const char*>(data), static_cast<std::size_t>(size)));
    archive::iarchive* archive = factory->getInputArchive(&bytes);
    const ReturnType result = port.push(*archive);
    factory->release(archive);
    return result;
}

/// Implements push() of a data port for an archive. Returns OPROS_UNSUPPORTED_METHOD if the port's type cannot be
/// archived. Throws the exceptions of the archive.
template <typename Port>
ReturnType push_decoded(Port& port, archive::iarchive& in) {
    opros_any value = port.sample();
    if (!value.serializable()) return OPROS_UNSUPPORTED_METHOD;
    value.decode(in);
    return port.push(value);
}

} // namespace detail
} // namespace opros

#endif
