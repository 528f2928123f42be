// SPDX-License-Identifier: Apache-2.0
#ifndef OPROS_STRING_IARCHIVE_H
#define OPROS_STRING_IARCHIVE_H

#include <archive/opros_iarchive_stl.h>

#include <istream>
#include <string>
#include <vector>

namespace opros {
namespace archive {

/// Reads the format of string_oarchive in both modes. Throws an archive exception for any other input.
class string_iarchive : public iarchive {
  public:
    /// The stream must be seekable and outlive the archive.
    explicit string_iarchive(std::istream* is) : iarchive(true), m_is(is) {}
    using iarchive::load;

#define OPROS_LOAD_PRIMITIVE(type) virtual iarchive& load(type& value);
    OPROS_FOR_EACH_PRIMITIVE(OPROS_LOAD_PRIMITIVE)
#undef OPROS_LOAD_PRIMITIVE
    virtual iarchive& load(std::string& value);
    virtual iarchive& load(std::wstring& value);
    virtual iarchive& load_binary(char** p, long& size);
    virtual std::size_t read_sequence_head();
    virtual iarchive& read_class_head(const std::string& name);
    virtual iarchive& read_class_end(const std::string& name);
    virtual iarchive& read_container_name(const std::string& name);
    virtual iarchive& read_sequence_end();
    virtual long read_array_head(long size, char code, char bytes);
    virtual iarchive& read_array_end(long size, char code, char bytes);

  private:
    template <typename T>
    iarchive& get(char code, T& value);
    void expect(char code);
    std::string up_to(char end);
    void get_blob(std::string& bytes);

    std::istream* m_is;
    bool m_named = false;       // the next sequence is a container
    std::vector<bool> m_inside; // for each open sequence: whether it is a container
};

} // namespace archive
} // namespace opros

#endif
