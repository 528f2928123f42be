// SPDX-License-Identifier: Apache-2.0
// A thread as an object, and UUIDs.
#include "host/process/start_thread.hpp"
#include <coil/Task.h>
#include <coil/UUID.h>
#include <fstream>

namespace coil {

Task::~Task() {
    // As OpenRTM-aist's: a derived class whose thread uses members waits for it in its own destructor.
    if (thread_.joinable()) thread_.detach();
}
// Hooks of OpenRTM-aist's interface (from ACE), for derived classes.
int Task::open(void*) { return 0; }
int Task::close(unsigned long) { return 0; }
int Task::svc() { return 0; }
// Does nothing while the thread runs.
void Task::activate() {
    // A thread that has ended is joined, so that the task can run again.
    if (ended_ && thread_.joinable()) thread_.join();
    if (thread_.joinable()) return;
    ended_ = false;
    thread_ = tandem::process::start_thread([this] {
        svc();
        ended_ = true;
        finalize(); // may delete this task, so nothing comes after it
    });
}
int Task::wait() {
    if (thread_.joinable()) thread_.join();
    return 0;
}
int Task::suspend() { return 0; }
int Task::resume() { return 0; }
void Task::reset() {}
void Task::finalize() { reset(); }

// The kernel makes a random one (version 4) at each read.
std::unique_ptr<UUID> UUID_Generator::generateUUID(int, int) {
    std::ifstream kernel("/proc/sys/kernel/random/uuid");
    std::string text;
    std::getline(kernel, text);
    return std::make_unique<UUID>(text);
}

} // namespace coil
