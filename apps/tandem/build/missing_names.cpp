// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/missing_names.hpp"
#include "apps/tandem/build/first_error.hpp"

#include <set>
#include <sstream>

namespace tandem::command {

std::map<std::string, std::string> missing_names(const std::string& output) {
    static const std::map<std::string, std::string> declarations{
        {"BOOL", "typedef int BOOL;"},
        {"BYTE", "typedef unsigned char BYTE;"},
        {"WORD", "typedef unsigned short WORD;"},
        {"DWORD", "typedef unsigned int DWORD;"},
        {"UINT", "typedef unsigned int UINT;"},
        {"TRUE", "#define TRUE 1"},
        {"FALSE", "#define FALSE 0"},
    };
    std::map<std::string, std::string> missing;
    std::istringstream lines(output);
    for (std::string line; std::getline(lines, line);) {
        if (const auto known = declarations.find(unknown_name(line)); known != declarations.end())
            missing.insert(*known);
        if (line.find("did you forget to") == std::string::npos) continue; // advice of g++
        if (const auto header = between(line, "#include <", ">"); !header.empty())
            missing.emplace("<" + header + ">", "#include <" + header + ">");
    }
    return missing;
}

bool is_windows_name(const std::string& name) {
    static const std::set<std::string> names{
        "CloseHandle",  "CreateEvent",     "CreateFile",     "CreateMutex",   "CreateThread",
        "CString",      "FreeLibrary",     "GetProcAddress", "GetTickCount",  "HANDLE",
        "HINSTANCE",    "HMODULE",         "HWND",           "LARGE_INTEGER", "LoadLibrary",
        "LoadLibraryA", "LoadLibraryW",    "LPCSTR",         "LPCTSTR",       "LPSTR",
        "LPTSTR",       "LPVOID",          "MessageBox",     "ReleaseMutex",  "SetEvent",
        "Sleep",        "SOCKET",          "timeGetTime",    "WSADATA",       "WaitForSingleObject",
        "WSAStartup",   "CRITICAL_SECTION"};
    return names.count(name) != 0;
}

} // namespace tandem::command
