// SPDX-License-Identifier: Apache-2.0
// A shared library by dlopen(3). 0 or -1 as in OpenRTM-aist; dlerror() has the reason.
#include <coil/DynamicLib.h>

namespace coil {

// Qualified calls: a constructor or destructor must not call a derived class's override.
DynamicLib::DynamicLib(const char* dynlib_name, int open_mode, int close_handle_on_destruction)
    : m_closeflag(close_handle_on_destruction) {
    DynamicLib::open(dynlib_name, open_mode, close_handle_on_destruction);
}

DynamicLib::~DynamicLib() {
    if (m_closeflag == 1 && m_handle != nullptr) DynamicLib::close();
}

// dlopen() counts references: each copy opens the library again and closes it for itself.
DynamicLib::DynamicLib(const DynamicLib& rhs) : m_closeflag(rhs.m_closeflag) {
    if (rhs.m_handle != nullptr) DynamicLib::open(rhs.m_name.c_str(), rhs.m_mode, rhs.m_closeflag);
}

DynamicLib& DynamicLib::operator=(const DynamicLib& rhs) {
    if (this == &rhs) return *this;
    if (m_closeflag == 1 && m_handle != nullptr) DynamicLib::close();
    m_handle = nullptr;
    m_closeflag = rhs.m_closeflag;
    if (rhs.m_handle != nullptr) DynamicLib::open(rhs.m_name.c_str(), rhs.m_mode, rhs.m_closeflag);
    return *this;
}

int DynamicLib::open(const char* dll_name, int open_mode, int close_handle_on_destruction) {
    // If this fails, a library that is open stays open.
    void* handle = ::dlopen(dll_name, open_mode);
    if (handle == nullptr) return -1;
    m_handle = handle;
    m_name = dll_name;
    m_mode = open_mode;
    m_closeflag = close_handle_on_destruction;
    return 0;
}

// The handle stays valid when dlclose() fails.
int DynamicLib::close() {
    if (m_handle == nullptr || ::dlclose(m_handle) != 0) return -1;
    m_handle = nullptr;
    return 0;
}

void* DynamicLib::symbol(const char* symbol_name) {
    return m_handle == nullptr ? nullptr : ::dlsym(m_handle, symbol_name);
}

} // namespace coil
