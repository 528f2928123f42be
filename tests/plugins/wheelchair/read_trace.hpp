// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "plugins/wheelchair/core/record/records.hpp"

#include <cstring>
#include <vector>

namespace tandem::wheelchair {

/// Returns the records of a trace file from number `first`; none if the file does not exist yet.
template <class Record>
std::vector<Record> read_trace(const std::string& path, std::uint64_t first = 0) {
    if (!trace_exists(path)) return {};
    const TraceReader reader(path, column_names<Record>());
    const auto doubles = reader.read(first, reader.size());
    std::vector<Record> out(doubles.size() / std::size(Record::names));
    if (!out.empty())
        std::memcpy(static_cast<void*>(out.data()), doubles.data(), out.size() * sizeof(Record));
    return out;
}

} // namespace tandem::wheelchair
