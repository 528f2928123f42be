// SPDX-License-Identifier: Apache-2.0
#ifndef COIL_SIGNAL_H
#define COIL_SIGNAL_H
#include <csignal>

namespace coil {

using SignalHandler = void (*)(int);

/// Sets the handler of a signal. The destructor does not reset it.
class SignalAction {
  public:
    SignalAction() = default;
    SignalAction(SignalHandler handle, int signum) {
        struct sigaction action {};
        action.sa_handler = handle;
        ::sigemptyset(&action.sa_mask);
        ::sigaction(signum, &action, nullptr);
    }
    SignalAction(const SignalAction&) = delete;
    SignalAction& operator=(const SignalAction&) = delete;
};

} // namespace coil
#endif
