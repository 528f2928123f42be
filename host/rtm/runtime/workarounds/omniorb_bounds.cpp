// SPDX-License-Identifier: Apache-2.0
// Replaces a function of omniORB 4.2 and 4.3, which trusts the length in a message. A length of 2^31 or more, of a string
// in an `any`, makes that function write beyond its buffer. omniORB calls it through the dynamic symbol table, which finds
// the definition in this library first.
#include <algorithm>
#include <array>
#include <omniORB4/CORBA.h>

void cdrStream::copy_to(cdrStream& stream, int size, omni::alignment_t align) {
    if (size < 0 || !checkInputOverrun(1, static_cast<_CORBA_ULong>(size), align))
        throw CORBA::MARSHAL(0, CORBA::COMPLETED_MAYBE);
    std::array<CORBA::Octet, 4096> chunk; // a multiple of every alignment
    while (size > 0) {
        const int now = std::min(size, static_cast<int>(chunk.size()));
        get_octet_array(chunk.data(), now, align);
        stream.put_octet_array(chunk.data(), now, align);
        align = omni::ALIGN_1; // only the first chunk needs padding
        size -= now;
    }
}
