// SPDX-License-Identifier: Apache-2.0
#include "shm/ring/ring_reader.hpp"

#include "shm/os/error.hpp"

namespace tandem::shm {

template class RingConsumer<RealAtomics>;

RingReader::RingReader(RingHandle ring) : ring_(std::move(ring)), consumer_(ring_.view) {
    const std::string& path = ring_.mapping->path();
    if (ring_.writer == ring_.mapping->side())
        throw Error(path + ": a ring written by side " + name_of(ring_.writer) +
                    " cannot be read here; use RingWriter");
    if (consumer_.corrupt())
        throw Error(path + ": a ring to be read is damaged; leave the segment and join again");
}

} // namespace tandem::shm
