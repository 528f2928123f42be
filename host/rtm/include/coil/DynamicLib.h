// SPDX-License-Identifier: Apache-2.0
#ifndef COIL_DYNAMICLIB_H
#define COIL_DYNAMICLIB_H
#include <dlfcn.h>
#include <string>

#define COIL_DEFAULT_DYNLIB_MODE RTLD_LAZY

namespace coil {

/// A shared library. The destructor closes it unless `close_handle_on_destruction` is 0.
class DynamicLib {
  public:
    explicit DynamicLib(int close_handle_on_destruction = 1) : m_closeflag(close_handle_on_destruction) {}
    DynamicLib(const char* dynlib_name, int open_mode = COIL_DEFAULT_DYNLIB_MODE,
               int close_handle_on_destruction = 1);
    virtual ~DynamicLib();
    /// Opens the same library again, so that each object has its own handle.
    DynamicLib(const DynamicLib& rhs);
    DynamicLib& operator=(const DynamicLib& rhs);

    /// Returns 0, or -1 on failure; error() returns the reason.
    virtual int open(const char* dll_name, int open_mode = COIL_DEFAULT_DYNLIB_MODE,
                     int close_handle_on_destruction = 1);
    virtual int close();
    /// Returns NULL if there is no such symbol or no library is open.
    void* symbol(const char* symbol_name);
    static const char* error() { return ::dlerror(); }

  private:
    std::string m_name;
    int m_mode = COIL_DEFAULT_DYNLIB_MODE;
    int m_closeflag;
    void* m_handle = nullptr;
};

} // namespace coil
#endif
