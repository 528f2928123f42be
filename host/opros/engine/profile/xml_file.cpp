// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/profile/xml_file.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iconv.h>
#include <string>
#include <string_view>

namespace tandem::engine {
namespace {

using namespace std::string_view_literals;

/// How the first bytes of a file reveal its encoding.
struct EncodingSignature {
    std::string_view first_bytes;
    std::size_t mark_size; ///< size of the byte order mark in bytes; the mark is not part of the text
    const char* encoding;
    std::size_t unit_size; ///< size of a code unit in bytes
};

/// Byte order marks, and '<' in 16 or 32 bits without a mark. The first match counts: UTF-32LE comes before UTF-16LE,
/// because its mark begins with the mark of UTF-16LE.
constexpr EncodingSignature signatures[] = {
    {"\xFF\xFE\0\0"sv, 4, "UTF-32LE", 4}, {"\0\0\xFE\xFF"sv, 4, "UTF-32BE", 4},
    {"<\0\0\0"sv, 0, "UTF-32LE", 4},      {"\0\0\0<"sv, 0, "UTF-32BE", 4},
    {"\xEF\xBB\xBF"sv, 3, "UTF-8", 1},    {"\xFF\xFE"sv, 2, "UTF-16LE", 2},
    {"\xFE\xFF"sv, 2, "UTF-16BE", 2},     {"<\0"sv, 0, "UTF-16LE", 2},
    {"\0<"sv, 0, "UTF-16BE", 2},
};

std::string to_upper(std::string_view text) {
    std::string upper(text);
    std::transform(upper.begin(), upper.end(), upper.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return upper;
}

/// Returns iconv's name for an encoding that Windows or Java tools name differently (MS932, WINDOWS-949, X-EUC-KR).
std::string iconv_name(std::string name) {
    if (name.starts_with("X-")) name.erase(0, 2);
    for (const std::string_view prefix : {"WINDOWS-"sv, "MS"sv, "CP-"sv})
        if (name.size() > prefix.size() && name.starts_with(prefix) &&
            std::isdigit(static_cast<unsigned char>(name[prefix.size()])) != 0)
            name = "CP" + name.substr(prefix.size());
    // Files that declare EUC-KR were written on Windows. Its code page 949 is a superset of EUC-KR.
    for (const char* korean : {"EUC-KR", "EUC_KR", "EUCKR", "KS_C_5601-1987", "KS_C_5601-1989", "KSC5601",
                               "KSC_5601", "KS_C_5601", "KOREAN"})
        if (name == korean) return "CP949";
    return name;
}

/// Returns iconv's name for the encoding in the XML declaration, or an empty string if there is none. Checks the
/// characters, because iconv_open() interprets text after '/' as options.
std::string declared_encoding(std::string_view bytes) {
    const std::string_view head = bytes.substr(0, std::min<std::size_t>(bytes.find("?>"), 200));
    if (!head.starts_with("<?xml")) return "";
    const auto at = head.find("encoding");
    if (at == std::string_view::npos) return "";
    const auto open = head.find_first_of("\"'", at);
    if (open == std::string_view::npos) return "";
    const auto close = head.find(head[open], open + 1);
    if (close == std::string_view::npos) return "";
    const std::string name = to_upper(head.substr(open + 1, close - open - 1));
    if (name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._:-") != std::string::npos) return "";
    return iconv_name(name);
}

/// An iconv descriptor for the conversion from an encoding to UTF-8.
class Utf8Converter {
  public:
    explicit Utf8Converter(const std::string& from) : handle_(iconv_open("UTF-8", from.c_str())) {}
    ~Utf8Converter() {
        if (is_open()) iconv_close(handle_);
    }

    Utf8Converter(const Utf8Converter&) = delete;
    Utf8Converter& operator=(const Utf8Converter&) = delete;
    /// Returns false if iconv does not know the encoding.
    /// NOLINTNEXTLINE(performance-no-int-to-ptr): POSIX defines this error result of iconv_open()
    bool is_open() const { return handle_ != iconv_t(-1); }

    /// Replaces each invalid code unit of `unit_size` bytes by '?'. Sets `all_valid` to whether there were none.
    std::string convert(std::string_view bytes, std::size_t unit_size, bool& all_valid) {
        std::string out;
        char* in = const_cast<char*>(bytes.data()); // iconv's signature; it does not write there
        std::size_t left = bytes.size();
        all_valid = true;
        while (left > 0) {
            char chunk[4096];
            char* to = chunk;
            std::size_t room = sizeof chunk;
            const bool failed = iconv(handle_, &in, &left, &to, &room) == std::size_t(-1);
            out.append(chunk, static_cast<std::size_t>(to - chunk));
            if (!failed) break;
            // A full chunk is not an error. But a chunk that is "full" without any output would repeat forever.
            if (errno == E2BIG && to != chunk) continue;
            all_valid = false;
            out += '?';
            const std::size_t skipped = std::min(unit_size, left);
            in += skipped;
            left -= skipped;
        }
        return out;
    }

  private:
    iconv_t handle_;
};

bool is_utf8(std::string_view bytes) {
    bool all_valid = false;
    Utf8Converter("UTF-8").convert(bytes, 1, all_valid);
    return all_valid;
}

std::string convert_to_utf8(std::string_view bytes, const std::string& from, std::size_t unit_size) {
    bool all_valid = false;
    Utf8Converter converter(from);
    std::string text = converter.is_open() ? converter.convert(bytes, unit_size, all_valid)
                                           : Utf8Converter("UTF-8").convert(bytes, 1, all_valid);
    if (all_valid || unit_size > 1) return text;
    // OPRoS tools are Korean. If all bytes are valid in the Korean code page, it is a better guess than question
    // marks.
    std::string korean = Utf8Converter("CP949").convert(bytes, 1, all_valid);
    return all_valid ? korean : text;
}

/// Converts the bytes of an XML file to UTF-8. The encoding is taken from the byte order mark, otherwise from the
/// zero bytes around the first '<' (XML 1.0, appendix F), otherwise from the XML declaration. The declaration of real
/// profiles is often wrong, so bytes that are valid UTF-8 stay unchanged. Bytes that are not valid in any encoding
/// become '?' (names of ports and types are ASCII). Never throws because of the bytes.
std::string to_utf8(std::string_view bytes) {
    for (const EncodingSignature& signature : signatures)
        if (bytes.starts_with(signature.first_bytes))
            return convert_to_utf8(bytes.substr(signature.mark_size), signature.encoding,
                                   signature.unit_size);
    const std::string name = declared_encoding(bytes);
    // The declaration was readable as ASCII, so a declaration of 16 or 32 bits is wrong.
    const bool is_wide = name.starts_with("UTF-16") || name.starts_with("UTF-32") || name.starts_with("UCS");
    const bool use_utf8 = is_wide || name.empty() || is_utf8(bytes);
    return convert_to_utf8(bytes, use_utf8 ? "UTF-8" : name, 1);
}

} // namespace

std::string tag(const char* name) { return std::string("<").append(name).append(">"); }

namespace {

std::string read_profile_bytes(const std::filesystem::path& file) {
    const auto fail = [&](const std::string& why) {
        throw SetupError("profile " + file.string() + " cannot be read: " + why);
    };
    // Checks the type first: opening a pipe would block, and a device may never end.
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (status.type() == std::filesystem::file_type::not_found) fail("no such file");
    if (error) fail(error.message());
    if (!std::filesystem::is_regular_file(status)) fail("it is not a file");
    std::ifstream stream(file, std::ios::binary);
    if (!stream) fail("permission denied");
    // Reads one byte more than allowed, which detects any larger file without reading it to the end.
    std::string bytes(max_profile_bytes + 1, '\0');
    stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(stream.gcount()));
    if (bytes.size() > max_profile_bytes)
        fail("it has more than " + std::to_string(max_profile_bytes) + " bytes, which no profile needs");
    return bytes;
}

} // namespace

XmlFile::XmlFile(const std::filesystem::path& file) : XmlFile(file, read_profile_bytes(file)) {}

XmlFile::XmlFile(const std::filesystem::path& file, std::string_view bytes)
    : file_(file), text_(to_utf8(bytes)) {
    for (std::size_t i = 0; i < text_.size(); ++i)
        if (text_[i] == '\n') newline_offsets_.push_back(i);
    // pugixml would end the text at a zero byte and accept the part before it.
    if (const auto zero = text_.find('\0'); zero != std::string::npos)
        throw SetupError({file_, line_at(static_cast<std::ptrdiff_t>(zero))},
                         "not well-formed XML: there is a zero byte");
    const auto result = document_.load_buffer(text_.data(), text_.size(),
                                              pugi::parse_default | pugi::parse_doctype, pugi::encoding_utf8);
    if (!result)
        throw SetupError({file_, line_at(result.offset)},
                         std::string("not well-formed XML: ") + result.description());
    reject_entities();
}

// pugixml does not expand entities of the document type, so it would misread a file that uses them. A file with
// nested entities is an attack on parsers that do expand them.
void XmlFile::reject_entities() const {
    for (const pugi::xml_node& node : document_.children())
        if (node.type() == pugi::node_doctype &&
            std::string_view(node.value()).find("<!ENTITY") != std::string_view::npos)
            fail(node,
                 "the document type declares entities, expected plain XML; write their text in their place");
}

int XmlFile::line_at(std::ptrdiff_t offset) const {
    // pugixml returns -1 for a node without an offset.
    const auto position = static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0));
    const auto before = std::lower_bound(newline_offsets_.begin(), newline_offsets_.end(), position);
    return 1 + static_cast<int>(before - newline_offsets_.begin());
}

SourceLocation XmlFile::location(const pugi::xml_node& node) const {
    return {file_, line_at(node.offset_debug())};
}

void XmlFile::fail(const pugi::xml_node& node, const std::string& what) const {
    throw SetupError(location(node), what);
}

pugi::xml_node XmlFile::root(std::initializer_list<const char*> names) const {
    const pugi::xml_node root = document_.document_element();
    std::string expected;
    for (const char* name : names) {
        if (std::string(root.name()) == name) return root;
        expected.append(expected.empty() ? "" : " or ").append(tag(name));
    }
    fail(root, "root element is " + tag(root.name()) + ", expected " + expected);
}

std::string XmlFile::to_posix_path(std::string text) {
    std::replace(text.begin(), text.end(), '\\', '/');
    return text;
}

std::string XmlFile::trim(std::string_view text) {
    const char* blank = " \t\r\n";
    const auto first = text.find_first_not_of(blank);
    if (first == std::string_view::npos) return "";
    return std::string(text.substr(first, text.find_last_not_of(blank) - first + 1));
}

std::string XmlFile::keyword(std::string_view text) {
    std::string word = trim(text);
    std::transform(word.begin(), word.end(), word.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return word;
}

std::string XmlFile::child_text(const pugi::xml_node& node, const char* child) {
    return trim(node.child(child).child_value());
}

std::string XmlFile::required_child_text(const pugi::xml_node& node, const char* child) const {
    std::string value = child_text(node, child);
    if (value.empty())
        fail(node.child(child) ? node.child(child) : node, tag(node.name()) + " lacks its " + tag(child));
    return value;
}

std::string XmlFile::required_attribute(const pugi::xml_node& node, const char* name) const {
    std::string value = trim(node.attribute(name).value());
    if (value.empty()) fail(node, tag(node.name()) + " lacks its attribute " + name);
    return value;
}

double XmlFile::number(const pugi::xml_node& element, double default_value) const {
    const std::string value = trim(element.child_value());
    if (value.empty()) return default_value;
    double number = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (error != std::errc() || end != value.data() + value.size() || !std::isfinite(number))
        fail(element, tag(element.name()) + " is '" + value + "', expected a number");
    return number;
}

} // namespace tandem::engine
