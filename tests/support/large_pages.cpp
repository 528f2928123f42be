// SPDX-License-Identifier: Apache-2.0
// Replaces functions of the C library, so that the process sees a kernel with pages of TANDEM_TEST_PAGE_BYTES: sysconf() says so,
// mmap() returns addresses of such pages, and mmap() and madvise() refuse all others.
#include "tests/support/large_pages.hpp"

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdint>
#include <dlfcn.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace {

constexpr std::uintptr_t page = TANDEM_TEST_PAGE_BYTES;
std::atomic<std::size_t> refused{0};

template <class Function>
Function* of_c_library(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

/// Returns whether the kernel accepts the value; if not, sets errno.
bool begins_page(std::uintptr_t value) {
    if (value % page == 0) return true;
    ++refused;
    errno = EINVAL;
    return false;
}

using Map = void*(void*, std::size_t, int, int, int, off_t);

/// Returns the first page, in a new range of addresses, that is followed by room for `bytes`.
void* reserve_pages(Map* map, std::size_t bytes) {
    void* const range =
        map(nullptr, bytes + page, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (range == MAP_FAILED) return range;
    const auto begin = reinterpret_cast<std::uintptr_t>(range);
    return static_cast<std::byte*>(range) + (page - begin % page) % page;
}

} // namespace

std::size_t tandem::test::refused_for_page_size() { return refused; }

extern "C" {

long sysconf(int name) noexcept {
    static auto* const real = of_c_library<long(int)>("sysconf");
    return name == _SC_PAGESIZE ? static_cast<long>(page) : real(name);
}

void* mmap(void* address, std::size_t bytes, int protection, int flags, int file, off_t offset) noexcept {
    static auto* const real = of_c_library<Map>("mmap");
    if (!begins_page(static_cast<std::uintptr_t>(offset))) return MAP_FAILED;
    if ((flags & MAP_FIXED) == 0) {
        address = reserve_pages(real, bytes);
        if (address == MAP_FAILED) return address;
    } else if (!begins_page(reinterpret_cast<std::uintptr_t>(address))) {
        return MAP_FAILED;
    }
    return real(address, bytes, protection, flags | MAP_FIXED, file, offset);
}

int madvise(void* address, std::size_t bytes, int advice) noexcept {
    static auto* const real = of_c_library<int(void*, std::size_t, int)>("madvise");
    return begins_page(reinterpret_cast<std::uintptr_t>(address)) ? real(address, bytes, advice) : -1;
}

/// All arguments are words, whatever call it is.
long syscall(long number, ...) noexcept {
    static auto* const real = of_c_library<long(long, ...)>("syscall");
    std::va_list arguments;
    va_start(arguments, number);
    long words[6];
    for (long& word : words) word = va_arg(arguments, long);
    va_end(arguments);
    if (number == SYS_mmap && !begins_page(static_cast<std::uintptr_t>(words[0]))) return -1;
    return real(number, words[0], words[1], words[2], words[3], words[4], words[5]);
}
}
