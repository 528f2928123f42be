// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/harness/case.hpp"

namespace tandem::bench {

// The names are part of the JSON format and of the ids that users give to --only.
const char* name_of(Group group) {
    static constexpr const char* names[] = {"baseline", "tandem", "peer"};
    return names[static_cast<int>(group)];
}
const char* name_of(Wake wake) {
    static constexpr const char* names[] = {"-", "spin", "spin-then-futex", "blocking"};
    return names[static_cast<int>(wake)];
}
const char* name_of(PowerProfile profile) {
    static constexpr const char* names[] = {"normal", "low-latency-idle"};
    return names[static_cast<int>(profile)];
}
const char* name_of(Placement placement) {
    static constexpr const char* names[] = {"processes", "same-core", "threads", "alone"};
    return names[static_cast<int>(placement)];
}
const char* name_of(Unit unit) {
    static constexpr const char* names[] = {"ns", "GB/s", "M/s", "count", "ratio"};
    return names[static_cast<int>(unit)];
}

std::string size_text(std::size_t bytes) {
    if (bytes >= 1U << 20U && bytes % (1U << 20U) == 0) return std::to_string(bytes >> 20U) + "M";
    if (bytes >= 1U << 10U && bytes % (1U << 10U) == 0) return std::to_string(bytes >> 10U) + "K";
    return std::to_string(bytes);
}

std::string Case::id() const {
    std::string id = std::string(name_of(group)) + "/" + subject + "/" + operation + "/" + size_text(bytes);
    if (wake != Wake::none) id += std::string("/") + name_of(wake);
    if (!detail.empty()) id += "/" + detail;
    if (placement == Placement::threads) id += "/threads";
    // A case under normal conditions has the short name, because it is requested most often.
    if (conditions() != "normal") id += "/" + conditions();
    return id;
}

std::string Case::conditions() const {
    std::string text;
    const auto append = [&](const char* word) { text += (text.empty() ? "" : "+") + std::string(word); };
    if (power_profile != PowerProfile::normal) append(name_of(power_profile));
    if (placement == Placement::same_core) append(name_of(placement));
    if (loaded) append("loaded");
    return text.empty() ? "normal" : text;
}

std::string Case::comparison_key() const {
    // The cache line (8 bytes) and the 48-byte record are compared with the 64-byte message.
    const std::size_t size = bytes < 64 ? 64 : bytes;
    return operation + "/" + size_text(size) + "/" + conditions();
}

} // namespace tandem::bench
