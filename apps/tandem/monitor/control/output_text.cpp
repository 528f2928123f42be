// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/control/output_text.hpp"

#include "host/text/printable.hpp"

#include <unistd.h>

#include <algorithm>

namespace tandem::monitor {

std::size_t size_of(int file) {
    return static_cast<std::size_t>(std::max<off_t>(lseek(file, 0, SEEK_END), 0));
}

std::string text_in(int file, std::size_t size, std::size_t begin) {
    std::string text(size, '\0');
    const auto bytes = pread(file, text.data(), text.size(), static_cast<off_t>(begin));
    text.resize(bytes < 0 ? 0 : static_cast<std::size_t>(bytes));
    return text::printable_text(text);
}

std::string last_lines(int file, std::size_t most) {
    const std::size_t size = size_of(file);
    if (size <= most) return text_in(file, size);
    std::string text = text_in(file, most, size - most);
    return text.erase(0, text.find('\n') + 1);
}

} // namespace tandem::monitor
