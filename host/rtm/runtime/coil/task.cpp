// SPDX-License-Identifier: Apache-2.0
#include <coil/Task.h>
#include <coil/UUID.h>
#include <fstream>

namespace coil {

Task::~Task() {
    if (thread_.joinable()) thread_.detach(); // as the real one: who needs the end waits for it
}
int Task::open(void*) { return 0; }
int Task::close(unsigned long) { return 0; }
int Task::svc() { return 0; }
void Task::activate() {
    if (ended_ && thread_.joinable()) thread_.join();
    if (thread_.joinable()) return;
    ended_ = false;
    thread_ = std::thread([this] {
        svc();
        ended_ = true;
        finalize(); // may delete the task: the last thing done with it
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

std::unique_ptr<UUID> UUID_Generator::generateUUID(int, int) {
    std::ifstream kernel("/proc/sys/kernel/random/uuid");
    std::string text;
    std::getline(kernel, text);
    return std::make_unique<UUID>(text);
}

} // namespace coil
