// SPDX-License-Identifier: Apache-2.0
#include "host/process/sized_thread.hpp"

#include "host/process/start_thread.hpp"

#include <memory>
#include <utility>

namespace tandem::process {
namespace {

void* run(void* work) noexcept {
    const std::unique_ptr<std::function<void()>> owned(static_cast<std::function<void()>*>(work));
    (*owned)();
    return nullptr;
}

} // namespace

SizedThread::SizedThread(std::size_t stack_bytes, std::function<void()> work) {
    auto owned = std::make_unique<std::function<void()>>(std::move(work));
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, stack_bytes);
    const int error = pthread_create(&thread_, &attributes, run, owned.get());
    pthread_attr_destroy(&attributes);
    if (error != 0) throw NotStarted(error, "no thread can be started");
    static_cast<void>(owned.release()); // run() owns it
}

SizedThread::~SizedThread() { pthread_join(thread_, nullptr); }

} // namespace tandem::process
