// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/contents.hpp"

namespace tandem::mcap {

enum class SummaryState {
    sound,
    absent, ///< or incomplete, which the specification allows
    no_end, ///< the file does not end with a footer
    damaged,
};

/// Position and fields of the footer.
struct FooterPlace {
    std::uint64_t offset = 0;
    Footer footer;
};
std::optional<FooterPlace> find_footer(File& file);

/// Fills the contents from the summary. If the summary is damaged, sets `fault`; then the contents are unusable.
SummaryState read_summary(File& file, Contents& contents, std::string& fault);

} // namespace tandem::mcap
