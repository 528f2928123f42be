// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/newest_value.hpp"

#include "apps/tandem/observe/json_message.hpp"
#include "apps/tandem/output/format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace tandem::monitor {
void NewestValue::keep(const command::FollowedPort& port, const shm::FollowedRecord& record) {
    value_ = nullptr;
    note_.clear();
    fresh_ = false;
    if (record.bytes.size() > max_message)
        note_ = fmt::format("{} bytes, too long to show here", record.bytes.size());
    else if (!std::all_of(port.message.children.begin(), port.message.children.end(), command::takes_bytes))
        note_ = "this type is not shown here; use tandem echo";
    else {
        bytes_.assign(record.bytes.begin(), record.bytes.end());
        stamp_ = record.stamp;
        fresh_ = true;
    }
}

void NewestValue::decode(const command::FollowedPort& port) {
    if (!fresh_) return;
    fresh_ = false;
    try {
        value_ = command::message_to_json(port, bytes_, stamp_);
    } catch (const std::runtime_error& error) { // untrusted bytes of another process
        note_ = command::replace_nonprintable(error.what()).substr(0, max_text);
        return;
    }
    const std::string text = value_.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
    if (text.size() <= max_text) return;
    value_ = nullptr;
    note_ = text.substr(0, max_text) + " ...";
}

} // namespace tandem::monitor
