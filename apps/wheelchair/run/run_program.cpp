// SPDX-License-Identifier: Apache-2.0
#include "apps/wheelchair/run/run_program.hpp"

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "apps/wheelchair/run/child_process.hpp"
#include "plugins/wheelchair/core/record/scenario.hpp"

namespace tandem::wheelchair {

namespace {

/// An anonymous file: unlike a pipe it never makes one side wait for the other.
Fd memory_file(const std::string& content) {
    Fd file(memfd_create("tandem", MFD_CLOEXEC));
    std::size_t done = 0;
    while (done < content.size()) {
        const auto n = write(file.get(), content.data() + done, content.size() - done);
        if (n <= 0) throw InputError("no memory for the input of a program");
        done += static_cast<std::size_t>(n);
    }
    lseek(file.get(), 0, SEEK_SET);
    return file;
}

std::string content_of(const Fd& file) {
    struct stat info {};
    fstat(file.get(), &info);
    std::string text(static_cast<std::size_t>(info.st_size), '\0');
    const auto n = pread(file.get(), text.data(), text.size(), 0);
    text.resize(n > 0 ? static_cast<std::size_t>(n) : 0);
    const auto first = text.find_first_not_of(" \n");
    return first == text.npos ? "" : text.substr(first);
}

} // namespace

ProgramResult run_program(const std::vector<std::string>& command, const std::string& input,
                          const std::string& folder) {
    const Fd in = memory_file(input), output = memory_file(""), errors = memory_file("");
    ChildProcess child(command, {in.get(), output.get(), errors.get(), folder});
    const auto& ended = child.wait(std::chrono::minutes(1));
    if (!ended) return {-1, command.at(0) + " did not end within a minute", content_of(output)};
    return {ended->signalled ? -1 : ended->code, content_of(errors), content_of(output)};
}

} // namespace tandem::wheelchair
