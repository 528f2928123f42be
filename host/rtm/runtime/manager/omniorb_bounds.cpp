// SPDX-License-Identifier: Apache-2.0
// Takes the place of omniORB 4.2's function of this name, which believes every length that a message says:
// one of 2^31 or more, of a string in an `any`, writes behind the memory that is there for it.
#include <algorithm>
#include <array>
#include <omniORB4/CORBA.h>

void cdrStream::copy_to(cdrStream& stream, int size, omni::alignment_t align) {
    if (size < 0 || !checkInputOverrun(1, static_cast<_CORBA_ULong>(size), align))
        throw CORBA::MARSHAL(0, CORBA::COMPLETED_MAYBE);
    std::array<CORBA::Octet, 4096> some; // a multiple of every alignment
    while (size > 0) {
        const int now = std::min(size, static_cast<int>(some.size()));
        get_octet_array(some.data(), now, align);
        stream.put_octet_array(some.data(), now, align);
        align = omni::ALIGN_1;
        size -= now;
    }
}
