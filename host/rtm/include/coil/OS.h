// SPDX-License-Identifier: Apache-2.0
#ifndef COIL_OS_H
#define COIL_OS_H
#include <cstdlib>
#include <string>
#include <sys/types.h>
#include <sys/utsname.h>
#include <unistd.h>

namespace coil {

using utsname = ::utsname;
inline int uname(utsname* name) { return ::uname(name); }
using pid_t = ::pid_t;
inline pid_t getpid() { return ::getpid(); }
inline pid_t getppid() { return ::getppid(); }
inline char* getenv(const char* name) { return std::getenv(name); }
inline bool getenv(const char* name, std::string& value) {
    const char* found = std::getenv(name);
    if (found == nullptr) return false;
    value = found;
    return true;
}

/// getopt(3) as an object: each call returns the next option, or -1 at the end. Use one object at a time: getopt()
/// has global state.
class GetOpt {
  public:
    GetOpt(int argc, char* const argv[], const char* opt, int /*flag*/)
        : m_argc(argc), m_argv(argv), m_opt(opt) {}
    ~GetOpt() { ::optind = 1; }
    int operator()() {
        ::opterr = opterr;
        ::optind = optind;
        const int result = ::getopt(m_argc, m_argv, m_opt);
        optarg = ::optarg;
        optind = ::optind;
        optopt = ::optopt;
        return result;
    }

    char* optarg = nullptr;
    int optind = 1;
    int opterr = 1;
    int optopt = 0;

  private:
    int m_argc;
    char* const* m_argv;
    const char* m_opt;
};

} // namespace coil
#endif
