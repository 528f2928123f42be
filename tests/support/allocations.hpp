// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Returns how often this program has allocated memory so far; always 0 under a sanitizer.
long allocations();
