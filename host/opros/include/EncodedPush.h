// SPDX-License-Identifier: Apache-2.0
// Pushing of values and events that come as bytes, for the four typed ports. Ours.
#ifndef ENCODEDPUSH_H_
#define ENCODEDPUSH_H_

#include <ArchiveFactory.h>
#include <OPRoSTypes.h>
#include <ReturnType.h>

#include <sstream>
#include <string>

namespace opros {
namespace detail {

/// What pushData() and pushEvent() of a port do: push() of the archive that the bytes are read from.
template <typename Port>
ReturnType push_encoded(Port& port, ArchiveFactory* factory, unsigned char* data, int size) {
    if (!factory) return OPROS_UNSUPPORTED_METHOD;
    std::stringstream bytes(std::string(reinterpret_cast<const char*>(data), static_cast<std::size_t>(size)));
    archive::iarchive* archive = factory->getInputArchive(&bytes);
    const ReturnType result = port.push(*archive);
    factory->release(archive);
    return result;
}

/// What push() of a data port does with an archive. OPROS_UNSUPPORTED_METHOD: the port's type cannot be
/// archived. Throws what the archive throws.
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
