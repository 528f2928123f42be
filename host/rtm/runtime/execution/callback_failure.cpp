// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/execution/callback_failure.hpp"

#include <utility>

namespace RTC {
namespace {

struct Failure {
    const RTObject_impl* component = nullptr;
    std::string text;
};
thread_local Failure newest;

} // namespace

void note_callback_failure(const RTObject_impl* component, std::string text) {
    newest = {component, std::move(text)};
}

std::string take_callback_failure(const RTObject_impl* component) {
    const Failure taken = std::exchange(newest, {});
    return taken.component == component ? taken.text : "";
}

} // namespace RTC
