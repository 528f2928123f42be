// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/session/link_thread.hpp"

#include <pthread.h>

namespace tandem::link {
namespace {

thread_local bool is_link_thread = false;

} // namespace

void begin_link_thread(const char* name) {
    is_link_thread = true;
    pthread_setname_np(pthread_self(), name);
}

bool in_link_thread() { return is_link_thread; }

} // namespace tandem::link
