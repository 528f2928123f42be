// SPDX-License-Identifier: Apache-2.0
#include <coil/DynamicLib.h>

namespace coil {

DynamicLib::DynamicLib(const char* dynlib_name, int open_mode, int close_handle_on_destruction)
    : m_closeflag(close_handle_on_destruction) {
    DynamicLib::open(dynlib_name, open_mode, close_handle_on_destruction);
}

DynamicLib::~DynamicLib() {
    if (m_closeflag == 1 && m_handle != nullptr) DynamicLib::close();
}

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
    void* handle = ::dlopen(dll_name, open_mode);
    if (handle == nullptr) return -1;
    m_handle = handle;
    m_name = dll_name;
    m_mode = open_mode;
    m_closeflag = close_handle_on_destruction;
    return 0;
}

int DynamicLib::close() {
    if (m_handle == nullptr || ::dlclose(m_handle) != 0) return -1;
    m_handle = nullptr;
    return 0;
}

void* DynamicLib::symbol(const char* symbol_name) {
    return m_handle == nullptr ? nullptr : ::dlsym(m_handle, symbol_name);
}

} // namespace coil
