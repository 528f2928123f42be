// SPDX-License-Identifier: Apache-2.0
// Runs the profile target without libFuzzer, on the files of a folder changed in ways that follow from the
// input's number: fuzz_profile FOLDER [COUNT [FIRST]].
#include "tests/support/stress.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <unistd.h>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Random = std::minstd_rand;

std::vector<std::string> files_in(const char* folder) {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    std::vector<std::string> files;
    for (const auto& path : paths) {
        std::ifstream in(path, std::ios::binary);
        files.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    }
    return files;
}

/// One byte, one stretch gone, one doubled, or one from another file.
void change(std::string& text, const std::vector<std::string>& files, Random& random) {
    if (text.empty()) return;
    const std::size_t at = random() % text.size();
    const std::size_t length = std::min<std::size_t>(random() % 40, text.size() - at);
    const std::string& other = files[random() % files.size()];
    switch (random() % 5) {
    case 0:
        text[at] = static_cast<char>(random() >> 8U);
        break;
    case 1:
        text.erase(at, length);
        break;
    case 2:
        text.insert(at, text.substr(at, length));
        break;
    case 3:
        text.insert(at, other.substr(random() % other.size(), random() % 200));
        break;
    default:
        text.resize(at);
    }
}

} // namespace

int main(int count, char** arguments) {
    if (count < 2) return std::fprintf(stderr, "fuzz_profile FOLDER [COUNT [FIRST]]\n"), 2;
    const std::vector<std::string> files = files_in(arguments[1]);
    const std::uint64_t runs = count > 2 ? std::strtoull(arguments[2], nullptr, 10)
                                         : tandem::test::stress<std::uint64_t>(20'000, 10'000'000);
    const std::uint64_t first = count > 3 ? std::strtoull(arguments[3], nullptr, 10) : 1;
    for (std::uint64_t number = first; number < first + runs; ++number) {
        Random random(static_cast<std::uint32_t>(number * 2654435761U % 2147483646U + 1));
        std::string input = files[random() % files.size()];
        for (std::uint32_t changes = random() % 6; changes > 0; --changes) change(input, files, random);
        if (number % 1024 == 0) alarm(60); // an input without end is a finding, too
        LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
    }
    std::printf("%llu inputs from %llu on\n", static_cast<unsigned long long>(runs),
                static_cast<unsigned long long>(first));
}
