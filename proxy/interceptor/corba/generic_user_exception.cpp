// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/corba/generic_user_exception.hpp"

#include "proxy/interceptor/corba/transcoder.hpp"

namespace tandem::interceptor {

GenericUserException::GenericUserException(const wire::ExceptionType& type, std::vector<std::byte> fields)
    : id_(type.id), type_(type.fields), fields_(std::move(fields)) {
    // Converts the fields once in advance, because the ORB cannot replace an exception that it has begun to send.
    cdrMemoryStream scratch;
    GenericUserException::_NP_marshal(scratch);
}

const char* GenericUserException::_NP_repoId(int* size) const {
    *size = static_cast<int>(id_.size()) + 1;
    return id_.c_str();
}

void GenericUserException::_NP_marshal(cdrStream& stream) const {
    wire::CdrReader reader(fields_);
    from_cdr(type_, reader, stream);
}

} // namespace tandem::interceptor
