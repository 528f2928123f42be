// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/reply.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tandem::link {

/// An exception that has a repository id: in a reply whose status is user_exception.
struct ServiceException {
    std::string id;                ///< `IDL:M/TooFast:1.0`
    std::string text;              ///< one line, for messages
    std::vector<std::byte> fields; ///< in CDR, a message of its own
};

/// In CDR: id, text, padding to a multiple of 8, the fields.
Reply make_exception_reply(const ServiceException&);
/// Returns what the bytes, which another process wrote, hold; without an id when they are damaged.
ServiceException decode_service_exception(std::span<const std::byte>);

/// The repository id of the CORBA system exception that says how a call failed, `IDL:omg.org/CORBA/TIMEOUT:1.0`.
std::string system_exception_id(CallStatus status);

} // namespace tandem::link
