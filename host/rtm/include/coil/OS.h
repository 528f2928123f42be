// SPDX-License-Identifier: Apache-2.0
#ifndef COIL_OS_H
#define COIL_OS_H
#include <cstdlib>
#include <string>
#include <sys/types.h>
#include <unistd.h>

namespace coil {

using pid_t = ::pid_t;
inline pid_t getpid() { return ::getpid(); }
inline pid_t getppid() { return ::getppid(); }
inline const char* getenv(const char* name) { return std::getenv(name); }
inline bool getenv(const char* name, std::string& value) {
    const char* found = std::getenv(name);
    if (found == nullptr) return false;
    value = found;
    return true;
}

} // namespace coil
#endif
