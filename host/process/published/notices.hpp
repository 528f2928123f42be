// SPDX-License-Identifier: Apache-2.0
// Lists requests that this process does not fulfil: settings that are not in effect, components that it could not create, and
// other processes that do not get its messages. Also lists what it cannot show to observers. Other processes of the same user
// can read the list without asking this process: it is in a memory file without a path (memfd_create), which they find as
// /proc/PID/fd/N. The file ends with the process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace tandem::process {

enum class NoticeKind : std::uint64_t { none, setting, component, unseen, lost };

struct NoticePlace {
    std::uint64_t kind; ///< a NoticeKind; none: the place is free; written last when a notice takes it
    char text[504];     ///< the line that the log has; NUL-terminated and truncated to fit
};

struct Notices {
    static constexpr char magic_text[8] = {'T', 'A', 'N', 'D', 'N', 'O', 'T', '1'};
    static constexpr const char* file_name = "tandem-notices";
    static constexpr std::size_t places = 32; ///< further notices are only in the log
    char magic[8];
    NoticePlace place[places];
};

/// Lists one notice for as long as this object lives. The first object creates the file. If there is no file or no free
/// place in it, only the log has the notice. [construction and destruction: any-thread]
class OwnNotice {
  public:
    OwnNotice(NoticeKind kind, const std::string& text);
    ~OwnNotice();
    OwnNotice(const OwnNotice&) = delete;
    OwnNotice& operator=(const OwnNotice&) = delete;

  private:
    NoticePlace* place_ = nullptr;
};

/// Lists a notice until the process ends. Lists equal notices once. [any-thread]
void publish_notice(NoticeKind kind, const std::string& text);

} // namespace tandem::process
