// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tandem::link {

/// Names the calling thread and marks it as one of a link's threads. Call it first in such a thread.
void begin_link_thread(const char* name);

/// Returns whether the caller is one of a link's threads, which Link::close() would have to wait for. [any-thread]
bool in_link_thread();

} // namespace tandem::link
