// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/output/idl_identifier.hpp"
#include "host/text/split_names.hpp"

#include <algorithm>
#include <cctype>

namespace tandem::command {
namespace {

// A word that differs from a keyword only in capitals is not an identifier either (section 7.2.4).
constexpr const char* idl_keywords = R"(
    abstract alias any attribute bitfield bitmask bitset boolean case char component connector const consumes
    context custom default double emits enum eventtype exception factory false finder fixed float getraises home
    import in inout int16 int32 int64 int8 interface local long manages map mirrorport module multiple
    native object octet oneway out port porttype primarykey private provides public publishes raises
    readonly sequence setraises short string struct supports switch true truncatable typedef typeid typename
    typeprefix uint16 uint32 uint64 uint8 union unsigned uses valuebase valuetype void wchar wstring )";

} // namespace

std::string idl_identifier(const std::string& word) {
    static const std::vector<std::string> keywords = text::split_words(idl_keywords);
    std::string lower = word;
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    return std::find(keywords.begin(), keywords.end(), lower) != keywords.end() ? "_" + word : word;
}

} // namespace tandem::command
