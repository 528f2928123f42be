// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/bag/losses.hpp"

#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print_note.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tandem::command {

void Losses::add(const std::vector<std::string>& problems) {
    for (const std::string& problem : problems) add(problem);
}

void Losses::add(const std::string& problem) {
    // A file that is read several times shows the same problem each time.
    if (std::find(problems_.begin(), problems_.end(), problem) == problems_.end())
        problems_.push_back(problem);
}

int Losses::report() const {
    if (problems_.empty()) return 0;
    const std::size_t others = problems_.size() - 1;
    print_note("tandem: {}{}\n", replace_control_characters(problems_.front()),
               others == 0 ? std::string()
                           : fmt::format("; and {} other {}, see tandem bag check {}", others,
                                         others == 1 ? "fault" : "faults",
                                         replace_control_characters(file_.string())));
    return 1;
}

} // namespace tandem::command
