// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/setup_error.hpp"

#include <filesystem>
#include <initializer_list>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace tandem::engine {

/// No profile is larger: those of real components have 1 to 10 KB. The bound is for a wrong file name, such as
/// that of a log or a device.
constexpr std::size_t max_profile_bytes = 1 << 20;

/// An element as messages name it: "<name>".
std::string tag(const char* name);

/// A parsed XML file that knows the line of each element. It is read in whatever encoding it declares or is in
/// (encoding.hpp). Every function that finds something wrong throws a SetupError with file and line.
class XmlFile {
  public:
    /// Throws SetupError: not a readable regular file, more than max_profile_bytes, not well-formed, or with
    /// entities declared in its document type.
    explicit XmlFile(const std::filesystem::path& file);
    /// Parses `bytes`; `file` is for messages only.
    XmlFile(const std::filesystem::path& file, std::string_view bytes);

    /// The root element, which must have one of these names.
    pugi::xml_node root(std::initializer_list<const char*> names) const;
    pugi::xml_node root() const { return document_.document_element(); }
    SourceLocation location(const pugi::xml_node& node) const;
    /// Throws SetupError at the element's line.
    [[noreturn]] void fail(const pugi::xml_node& node, const std::string& what) const;

    /// Text of the child element, trimmed; empty when there is none.
    static std::string child_text(const pugi::xml_node& node, const char* child);
    std::string required_child_text(const pugi::xml_node& node, const char* child) const;
    std::string required_attribute(const pugi::xml_node& node, const char* name) const;
    /// The element's text as a finite number, or the default when the element is absent or empty.
    double number(const pugi::xml_node& element, double default_value) const;
    double number(const pugi::xml_node& node, const char* child, double default_value) const {
        return number(node.child(child), default_value);
    }

    /// Without white space at both ends.
    static std::string trim(std::string_view text);
    /// Trimmed and in lower case: for values that a profile chooses from a list, which may be in either case.
    static std::string keyword(std::string_view text);
    /// With '/' for each '\': profiles are mostly written on Windows.
    static std::string to_posix_path(std::string text);

  private:
    int line_at(std::ptrdiff_t offset) const;
    void reject_entities() const;

    std::filesystem::path file_;
    std::string text_;                         // in UTF-8; the document's offsets count in it
    std::vector<std::size_t> newline_offsets_; // in text_, ascending
    pugi::xml_document document_;
};

} // namespace tandem::engine
