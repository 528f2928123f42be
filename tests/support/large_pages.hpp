// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>

namespace tandem::test {

/// Returns the calls of mmap() and madvise() that a kernel with pages of TANDEM_TEST_PAGE_BYTES has refused, in a test that is
/// linked with large_pages.cpp.
std::size_t refused_for_page_size();

} // namespace tandem::test
