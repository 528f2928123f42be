// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/ring/ring_view.hpp"

namespace tandem::shm::test {

inline constexpr auto all_policies = {RingPolicy::latest_only, RingPolicy::drop_oldest, RingPolicy::reject,
                                      RingPolicy::wait};

} // namespace tandem::shm::test
