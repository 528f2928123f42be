// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/check/findings.hpp"

namespace tandem::mcap {

/// The schemas and channels of the data section, against which those of the summary are checked.
struct Definitions {
    std::map<std::uint16_t, Schema> schemas;
    std::map<std::uint16_t, Channel> channels;
};

/// Checks a record by itself, and against the one with the same id, and adds it if it is new. They throw Error for
/// damaged records.
void check_schema(const RecordView& record, Definitions& known, Findings& findings);
void check_channel(const RecordView& record, Definitions& known, Findings& findings);

} // namespace tandem::mcap
