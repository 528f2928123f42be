// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/check/findings.hpp"

namespace tandem::mcap {

/// The schemas and channels of the data section, to compare with those of the summary.
struct Definitions {
    std::map<std::uint16_t, Schema> schemas;
    std::map<std::uint16_t, Channel> channels;
};

/// Check a record by itself and against an earlier record with the same id. Add it if it is new. Throw Error for a
/// damaged record.
void check_schema(const RecordView& record, Definitions& known, Findings& findings);
void check_channel(const RecordView& record, Definitions& known, Findings& findings);

} // namespace tandem::mcap
