// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/reply.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tandem::link {

/// An exception with a repository id: the content of a reply with status user_exception.
struct ServiceException {
    std::string id;                ///< `IDL:M/TooFast:1.0`
    std::string text;              ///< one line, for messages
    std::vector<std::byte> fields; ///< a separate CDR message
};

/// Encodes in CDR: id, text, padding to a multiple of 8, the fields.
Reply make_exception_reply(const ServiceException&);
/// Decodes bytes from another process. The result has no id if they are damaged.
ServiceException decode_service_exception(std::span<const std::byte>);

/// Returns the reply of a call that has run and whose results cannot cross: an exception with this id.
Reply refuse_results(std::string_view text);
constexpr std::string_view refused_results_id = "IDL:omg.org/CORBA/MARSHAL:1.0";

/// Returns the repository id of the CORBA system exception for a failed call, for example
/// `IDL:omg.org/CORBA/TIMEOUT:1.0`.
std::string system_exception_id(CallStatus status);

} // namespace tandem::link
