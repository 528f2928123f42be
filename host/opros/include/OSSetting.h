// SPDX-License-Identifier: Apache-2.0
#ifndef OS_SETTING_H_
#define OS_SETTING_H_

// What upstream's headers define for the operating system, for components that test it.
#define OS_LINUX
#define OS_POSIX
#define OS_INVALID_HANDLE -1

typedef int OSHandle;
typedef void* ThreadFunctionReturn;

extern "C" {
typedef ThreadFunctionReturn (*ThreadFunction)(void*);
typedef void (*AIOCallBack)(int, int, void*);
}

#endif
