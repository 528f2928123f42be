// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/archive/signature_archive.hpp"

#include "proxy/adaptor/archive/type_code.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

namespace tandem::adaptor {

using opros::archive::iarchive;

namespace {

// A type that contains itself would be loaded without end.
constexpr std::size_t max_depth = 30;

/// A variable, so that a string_view can refer to it.
template <class T>
constexpr char type_code = code_of<T>();

} // namespace

long long SignatureArchive::next_value() { return leaf_ < values_.size() ? values_[leaf_++] : 0; }

/// Appends the code of the loaded type, after the name of its member.
void SignatureArchive::append(std::string_view text) {
    if (!name_.empty()) signature_ += '{' + std::exchange(name_, "") + '}';
    signature_ += text;
}

#define TANDEM_LOAD(type)                                                                                    \
    iarchive& SignatureArchive::load(type& value) {                                                          \
        value = static_cast<type>(next_value());                                                             \
        append({&type_code<type>, 1});                                                                       \
        return *this;                                                                                        \
    }
OPROS_FOR_EACH_PRIMITIVE(TANDEM_LOAD)
#undef TANDEM_LOAD

iarchive& SignatureArchive::load(std::string&) {
    next_value();
    append("s");
    return *this;
}

iarchive& SignatureArchive::load(std::wstring&) {
    next_value();
    append("w");
    return *this;
}

iarchive& SignatureArchive::load_binary(char** p, long& size) {
    next_value();
    append("ay");
    if (*p == nullptr) *p = new char[1](); // by the archive's contract the caller deletes it
    size = 0;
    return *this;
}

std::size_t SignatureArchive::read_sequence_head() {
    append("a");
    return 1; // one element, so that the type loads it and shows its signature
}

iarchive& SignatureArchive::read_class_head(const std::string&) {
    if (++depth_ > max_depth) throw RecursiveType();
    append("(");
    return *this;
}

iarchive& SignatureArchive::read_class_end(const std::string&) {
    --depth_;
    signature_ += ')';
    return *this;
}

long SignatureArchive::read_array_head(long size, char, char) {
    append('[' + std::to_string(size) + ']');
    return 1;
}

/// The macros take the name from the source text. Only the last identifier is kept: `x` of `pose.x` and of `"x"`.
iarchive& SignatureArchive::read_start_tag(const std::string& name) {
    const auto is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    const auto end = std::find_if(name.rbegin(), name.rend(), is_word);
    const auto begin = std::find_if_not(end, name.rend(), is_word);
    name_.assign(begin.base(), end.base());
    return *this;
}

} // namespace tandem::adaptor
