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

/// Profiles of real components have 1 to 10 KB. The limit rejects a wrong file name, such as a log or a device.
constexpr std::size_t max_profile_bytes = 1 << 20;

/// Returns an element's tag for messages: "<name>".
std::string tag(const char* name);

/// A parsed XML file that knows the line of each element. It detects the file's encoding. Every
/// function throws SetupError with file and line if it finds an error.
class XmlFile {
  public:
    /// Throws SetupError if the file is not a readable regular file, exceeds max_profile_bytes, is not well-formed,
    /// or declares entities in its document type.
    explicit XmlFile(const std::filesystem::path& file);
    /// Parses `bytes`. `file` is only for messages.
    XmlFile(const std::filesystem::path& file, std::string_view bytes);

    /// Returns the root element, which must have one of these names.
    pugi::xml_node root(std::initializer_list<const char*> names) const;
    pugi::xml_node root() const { return document_.document_element(); }
    SourceLocation location(const pugi::xml_node& node) const;
    /// Throws SetupError at the element's line.
    [[noreturn]] void fail(const pugi::xml_node& node, const std::string& what) const;

    /// Returns the trimmed text of the child element, or an empty string if there is no such child.
    static std::string child_text(const pugi::xml_node& node, const char* child);
    std::string required_child_text(const pugi::xml_node& node, const char* child) const;
    std::string required_attribute(const pugi::xml_node& node, const char* name) const;
    /// Returns the element's text as a finite number, or the default if the element is absent or empty.
    double number(const pugi::xml_node& element, double default_value) const;
    double number(const pugi::xml_node& node, const char* child, double default_value) const {
        return number(node.child(child), default_value);
    }

    /// Removes white space at both ends.
    static std::string trim(std::string_view text);
    /// Trims the text and converts it to lower case, for values from a fixed list in any case.
    static std::string keyword(std::string_view text);
    /// Replaces each '\' by '/': most profiles are written on Windows.
    static std::string to_posix_path(std::string text);

  private:
    int line_at(std::ptrdiff_t offset) const;
    void reject_entities() const;

    std::filesystem::path file_;
    std::string text_;                         // in UTF-8; the document's offsets refer to it
    std::vector<std::size_t> newline_offsets_; // in text_, ascending
    pugi::xml_document document_;
};

} // namespace tandem::engine
