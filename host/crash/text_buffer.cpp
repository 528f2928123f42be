// SPDX-License-Identifier: Apache-2.0
#include "host/crash/text_buffer.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <climits>
#include <cstring>
#define HAVE_DECL_BASENAME 1 // otherwise libiberty.h conflicts with glibc's basename()
#include <libiberty/demangle.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tandem::crash {
namespace {

/// The demangler's working memory is on the stack and grows with the name's length.
constexpr std::size_t max_mangled_length = 512;

/// Names of plugins and components must not control a terminal.
bool is_control(char c) {
    const auto byte = static_cast<unsigned char>(c); // char is signed on some processors
    return (byte < ' ' && c != '\n' && c != '\t') || byte == 0x7f;
}

} // namespace

TextBuffer& TextBuffer::operator<<(std::string_view text) {
    const std::size_t fitting = std::min(text.size(), text_.size() - size_);
    std::transform(text.begin(), text.begin() + fitting, text_.begin() + size_,
                   [](char c) { return is_control(c) ? '?' : c; });
    size_ += fitting;
    return *this;
}

TextBuffer& TextBuffer::decimal(std::int64_t number) {
    std::array<char, 24> digits;
    const auto end = std::to_chars(digits.begin(), digits.end(), number).ptr;
    return *this << std::string_view(digits.data(), static_cast<std::size_t>(end - digits.data()));
}

TextBuffer& TextBuffer::hexadecimal(std::uintptr_t number) {
    std::array<char, 24> digits;
    const auto end = std::to_chars(digits.begin(), digits.end(), number, 16).ptr;
    return *this << "0x" << std::string_view(digits.data(), static_cast<std::size_t>(end - digits.data()));
}

// libiberty's demangler passes the text in pieces and allocates no memory, unlike abi::__cxa_demangle().
TextBuffer& TextBuffer::demangled(const char* name, int options) {
    const auto append = [](const char* piece, std::size_t length, void* buffer) {
        *static_cast<TextBuffer*>(buffer) << std::string_view(piece, length);
    };
    const std::size_t before = size_;
    if (strnlen(name, max_mangled_length) < max_mangled_length &&
        cplus_demangle_v3_callback(name, options, append, this) != 0)
        return *this;
    size_ = before;
    return *this << name;
}

TextBuffer& TextBuffer::symbol(const char* name) { return demangled(name, DMGL_ANSI); }
TextBuffer& TextBuffer::type(const char* name) {
    return demangled(name, DMGL_PARAMS | DMGL_ANSI | DMGL_TYPES);
}

void TextBuffer::write_to_stderr() const {
    constexpr int patience_ms = 1000;
    struct stat file {};
    const bool pipe = fstat(STDERR_FILENO, &file) == 0 && S_ISFIFO(file.st_mode);
    const std::size_t longest =
        pipe ? PIPE_BUF : text_.size(); // a ready pipe takes this many bytes without blocking
    for (std::size_t written = 0; written < size_;) {
        pollfd ready{STDERR_FILENO, POLLOUT, 0};
        if (poll(&ready, 1, patience_ms) == 0) return;
        const ssize_t n = write(STDERR_FILENO, text_.data() + written, std::min(size_ - written, longest));
        if (n < 0 && errno != EINTR) return;
        if (n > 0) written += static_cast<std::size_t>(n);
    }
}

} // namespace tandem::crash
