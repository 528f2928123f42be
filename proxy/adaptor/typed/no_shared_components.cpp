// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/typed/no_shared_components.hpp"

#include "proxy/link/protocol/control.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tandem::adaptor {

link::PortTable NoSharedComponents::find(const std::vector<std::string>& names,
                                         const std::map<std::string, std::string>&, ComponentDirectory*,
                                         std::vector<std::string>& useless) {
    if (!names.empty())
        useless.push_back(
            fmt::format("property 'share' names {}: this engine does not let one component find "
                        "another; they are not shown as RTCs",
                        fmt::join(names, ", ")));
    return {};
}

link::Reply NoSharedComponents::serve(const link::Request& request) const {
    if (request.operation != link::control::listen || !link_)
        return link::Reply::failure(link::CallStatus::no_such_operation, "unknown command");
    try {
        link_->serve_listen(request.arguments);
        return {};
    } catch (const link::LinkError& error) {
        return link::Reply::failure(link::CallStatus::bad_arguments, error.what());
    }
}

} // namespace tandem::adaptor
