// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/missing_names.hpp"
#include "apps/tandem/build/first_error.hpp"
#include "host/text/split_names.hpp"

#include <algorithm>
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
        {"Sleep", "static inline void Sleep(unsigned int milliseconds) { usleep(1000 * milliseconds); }"},
        {"_mkdir", "static inline int _mkdir(const char* path) { return mkdir(path, 0777); }"},
    };
    static const std::map<std::string, std::string> headers{{"Sleep", "<unistd.h>"},
                                                            {"_mkdir", "<sys/stat.h>"}};
    std::map<std::string, std::string> missing;
    std::istringstream lines(output);
    for (std::string line; std::getline(lines, line);) {
        const auto name = unknown_name(line);
        if (const auto known = declarations.find(name); known != declarations.end()) missing.insert(*known);
        if (const auto header = headers.find(name); header != headers.end())
            missing.emplace(header->second, "#include " + header->second);
        // Advice of g++ 12, and of later ones.
        if (line.find("did you forget to") == std::string::npos &&
            line.find("fixable by adding") == std::string::npos)
            continue;
        if (const auto header = between(line, "#include <", ">"); !header.empty())
            missing.emplace("<" + header + ">", "#include <" + header + ">");
    }
    return missing;
}

bool is_windows_name(const std::string& name) {
    static const auto names = text::split_words(R"(
        _getch _kbhit _sleep _T ClearCommError CloseHandle closesocket CoInitialize CoInitializeEx
        COMMTIMEOUTS CP_ACP CP_UTF8 CreateEvent CreateFile CreateMutex CreateThread CRITICAL_SECTION
        CString DCB EnterCriticalSection FreeLibrary GENERIC_READ GetAsyncKeyState GetCommState
        GetLastError GetProcAddress GetTickCount HANDLE HINSTANCE HMODULE HRESULT HWND
        InitializeCriticalSection INVALID_HANDLE_VALUE kbhit LARGE_INTEGER LoadLibrary LoadLibraryA
        LoadLibraryW LPCSTR LPCTSTR LPCWSTR LPSTR LPTSTR LPVOID LPWSTR MessageBox
        MultiByteToWideChar OutputDebugString PurgeComm QueryPerformanceCounter
        QueryPerformanceFrequency ReleaseMutex SetCommState SetCommTimeouts SetEvent SOCKET TCHAR
        timeGetTime WaitForSingleObject WideCharToMultiByte WINAPI WSADATA WSAStartup ZeroMemory )");
    return std::find(names.begin(), names.end(), name) != names.end();
}

} // namespace tandem::command
