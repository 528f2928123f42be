// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/contents.hpp"

namespace tandem::mcap {

enum class SummaryState {
    sound,
    absent, ///< or it does not list everything, as the specification allows
    no_end, ///< the file does not end with a footer
    damaged,
};

/// The footer's place and fields; none if the file does not end with a footer and the magic bytes.
struct FooterPlace {
    std::uint64_t offset = 0;
    Footer footer;
};
std::optional<FooterPlace> find_footer(File& file);

/// Fills the contents from the summary. `fault` says what is damaged; then the contents are not to be used.
SummaryState read_summary(File& file, Contents& contents, std::string& fault);

} // namespace tandem::mcap
