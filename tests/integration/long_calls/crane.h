// SPDX-License-Identifier: Apache-2.0
// The work of a crane: a step every 10 ms, until it is done or the call is cancelled.
#pragma once
#include <TandemCall.h>

#include <chrono>
#include <iostream>
#include <string>
#include <syncstream>
#include <thread>

inline void say(const std::string& text) { std::osyncstream(std::cout) << text + "\n" << std::flush; }

/// Returns the steps made.
inline int work(const std::string& what, int steps) {
    say("crane: " + what + " begins");
    int done = 0;
    for (; done < steps && !tandem::call_cancelled(); ++done) {
        tandem::set_call_progress(static_cast<double>(done) / steps);
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    say("crane: " + what + (done == steps ? " done" : " stopped"));
    return done;
}
