// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/profile/encoding.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <iconv.h>

namespace tandem::engine {
namespace {

using namespace std::string_view_literals;

struct Guess {
    std::string_view start; ///< the file's first bytes
    std::size_t mark;       ///< how many of them are no text
    const char* encoding;
};

/// Byte order marks, then a '<' of 32 or of 16 bits. The longer ones come first.
constexpr Guess guesses[] = {
    {"\xFF\xFE\0\0"sv, 4, "UTF-32LE"}, {"\0\0\xFE\xFF"sv, 4, "UTF-32BE"}, {"<\0\0\0"sv, 0, "UTF-32LE"},
    {"\0\0\0<"sv, 0, "UTF-32BE"},      {"\xEF\xBB\xBF"sv, 3, "UTF-8"},    {"\xFF\xFE"sv, 2, "UTF-16LE"},
    {"\xFE\xFF"sv, 2, "UTF-16BE"},     {"<\0"sv, 0, "UTF-16LE"},          {"\0<"sv, 0, "UTF-16BE"},
};

std::string upper(std::string_view text) {
    std::string up(text);
    std::transform(up.begin(), up.end(), up.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return up;
}

/// The names of Windows and of Java's tools, which iconv has not: MS932, windows-949, x-euc-kr.
std::string known_name(std::string name) {
    if (name.starts_with("X-")) name.erase(0, 2);
    for (const std::string_view prefix : {"WINDOWS-"sv, "MS"sv, "CP-"sv})
        if (name.size() > prefix.size() && name.starts_with(prefix) && std::isdigit(name[prefix.size()]) != 0)
            name = "CP" + name.substr(prefix.size());
    // What calls itself EUC-KR comes from Windows, whose code page has some more characters.
    for (const char* korean : {"EUC-KR", "EUC_KR", "EUCKR", "KS_C_5601-1987", "KS_C_5601-1989", "KSC5601",
                               "KSC_5601", "KS_C_5601", "KOREAN"})
        if (name == korean) return "CP949";
    return name;
}

/// The value of encoding= in the XML declaration, in capitals; empty when there is none.
std::string declared(std::string_view bytes) {
    const std::string_view head = bytes.substr(0, std::min<std::size_t>(bytes.find("?>"), 200));
    if (!head.starts_with("<?xml")) return "";
    const auto at = head.find("encoding");
    if (at == std::string_view::npos) return "";
    const auto open = head.find_first_of("\"'", at);
    if (open == std::string_view::npos) return "";
    const auto close = head.find(head[open], open + 1);
    if (close == std::string_view::npos) return "";
    const std::string name = upper(head.substr(open + 1, close - open - 1));
    if (name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._:-") != std::string::npos) return "";
    return known_name(name);
}

class Converter {
  public:
    explicit Converter(const std::string& from) : handle_(iconv_open("UTF-8", from.c_str())) {}
    ~Converter() {
        if (known()) iconv_close(handle_);
    }
    Converter(const Converter&) = delete;
    Converter& operator=(const Converter&) = delete;
    bool known() const { return handle_ != iconv_t(-1); }

    /// What cannot be converted becomes '?', unit by unit. `fits` says whether there was such.
    std::string convert(std::string_view bytes, std::size_t unit, bool& fits) {
        std::string out;
        char* in = const_cast<char*>(bytes.data());
        std::size_t left = bytes.size();
        fits = true;
        while (left > 0) {
            char chunk[4096];
            char* to = chunk;
            std::size_t room = sizeof chunk;
            const bool failed = iconv(handle_, &in, &left, &to, &room) == std::size_t(-1);
            out.append(chunk, static_cast<std::size_t>(to - chunk));
            if (!failed) break;
            if (errno == E2BIG && to != chunk) continue;
            fits = false;
            out += '?';
            const std::size_t skipped = std::min(unit, left);
            in += skipped;
            left -= skipped;
        }
        return out;
    }

  private:
    iconv_t handle_;
};

bool is_utf8(std::string_view bytes) {
    bool fits = false;
    Converter("UTF-8").convert(bytes, 1, fits);
    return fits;
}

std::string converted(std::string_view bytes, const std::string& from, std::size_t unit) {
    bool fits = false;
    Converter converter(from);
    const std::string text =
        converter.known() ? converter.convert(bytes, unit, fits) : Converter("UTF-8").convert(bytes, 1, fits);
    if (fits || unit > 1) return text;
    // The tools' own language is a better guess than question marks, if it fits.
    const std::string korean = Converter("CP949").convert(bytes, 1, fits);
    return fits ? korean : text;
}

} // namespace

std::string to_utf8(std::string_view bytes) {
    for (const Guess& guess : guesses) {
        if (!bytes.starts_with(guess.start)) continue;
        const std::string name = guess.encoding;
        return converted(bytes.substr(guess.mark), name,
                         name == "UTF-8" ? 1U : (name.starts_with("UTF-16") ? 2U : 4U));
    }
    const std::string name = declared(bytes);
    // A declaration of 16 or 32 bits that can be read as ASCII is wrong about itself.
    const bool wide = name.starts_with("UTF-16") || name.starts_with("UTF-32") || name.starts_with("UCS");
    return wide || name.empty() || is_utf8(bytes) ? converted(bytes, "UTF-8", 1) : converted(bytes, name, 1);
}

} // namespace tandem::engine
