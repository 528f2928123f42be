// SPDX-License-Identifier: Apache-2.0
// The names of segments in /dev/shm, which any user may give to any file.
#include "shm/os/error.hpp"
#include "shm/segment/segment_file.hpp"

#include <algorithm>
#include <filesystem>
#include <random>
#include <string_view>
#include <tuple>

namespace tandem::shm {
namespace {

constexpr std::string_view prefix = "tandem.";
/// Names that one listing looks at. Only a user who keeps adding files makes /dev/shm hold more.
constexpr std::size_t max_names = std::size_t{1} << 22;

std::optional<std::uint64_t> parse_generation(const std::string& text) {
    if (text.empty() || text.size() > 18 || text[0] == '0') return std::nullopt; // see max_generation
    if (text.find_first_not_of("0123456789") != std::string::npos) return std::nullopt;
    return std::stoull(text);
}

/// Parses tandem.<link>.<generation>. A link's name has no dot.
std::optional<SegmentName> parse_name(const std::string& name) {
    const auto dot = name.rfind('.');
    if (name.compare(0, prefix.size(), prefix) != 0 || dot <= prefix.size()) return std::nullopt;
    std::string link = name.substr(prefix.size(), dot - prefix.size());
    const auto generation = parse_generation(name.substr(dot + 1));
    if (!generation || link.find('.') != std::string::npos) return std::nullopt;
    return SegmentName{std::move(link), *generation};
}

/// Calls `use` with the name of each file in /dev/shm.
template <class Use>
void for_each_name(Use&& use) {
    std::error_code failure;
    std::size_t names = 0;
    for (std::filesystem::directory_iterator at(shm_directory, failure), end;
         !failure && at != end && names < max_names; at.increment(failure), ++names)
        use(at->path().filename().string());
    if (failure)
        throw Error(std::string(shm_directory) + ": cannot be listed (" + failure.message() +
                    "); mount a tmpfs there");
}

} // namespace

std::vector<SegmentName> list_segment_names() {
    std::vector<SegmentName> found;
    for_each_name([&](const std::string& name) {
        if (auto parsed = parse_name(name)) found.push_back(std::move(*parsed));
    });
    std::sort(found.begin(), found.end(), [](const SegmentName& a, const SegmentName& b) {
        return std::tie(a.link, b.generation) < std::tie(b.link, a.generation);
    });
    return found;
}

std::vector<std::uint64_t> list_generations(const std::string& link) {
    std::vector<std::uint64_t> found;
    const std::string begin = file_prefix(link);
    for_each_name([&](const std::string& name) {
        if (name.compare(0, begin.size(), begin) != 0) return;
        if (const auto generation = parse_generation(name.substr(begin.size()))) found.push_back(*generation);
    });
    std::sort(found.rbegin(), found.rend());
    return found;
}

std::uint64_t next_generation(const std::string& link, std::uint64_t newest, const Access& access) {
    constexpr int max_tries = 16;
    std::uint64_t generation = newest + 1;
    std::random_device random; // of the system, so that nobody can take the names in advance
    for (int i = 0; i < max_tries; ++i) {
        if (generation > max_generation)
            throw Error(segment_path(link, newest) +
                        ": has the last generation for which there is a name; stop both hosts and remove it");
        if (!probe_segment(segment_path(link, generation), access).foreign) return generation;
        generation += 1 + random();
    }
    throw Error(segment_path(link, newest + 1) + ": this name and " + std::to_string(max_tries - 1) +
                " later ones, chosen at random, belong to files of other users; remove these files");
}

} // namespace tandem::shm
