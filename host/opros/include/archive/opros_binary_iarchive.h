// SPDX-License-Identifier: Apache-2.0
#ifndef OPROS_BINARY_IARCHIVE_H
#define OPROS_BINARY_IARCHIVE_H

#include <archive/opros_binary.h>
#include <archive/opros_iarchive_stl.h>

#include <istream>

namespace opros {
namespace archive {

/// Reads the format of binary_oarchive (opros_binary_oarchive.h). Throws an archive exception for any other input.
class binary_iarchive : public iarchive {
  public:
    /// The stream must be seekable, like a string stream or a file, and must outlive the archive.
    explicit binary_iarchive(std::istream* is) : iarchive(true), m_is(is), m_bare(false) {}
    using iarchive::load;

#define OPROS_LOAD_PRIMITIVE(type) virtual iarchive& load(type& value);
    OPROS_FOR_EACH_PRIMITIVE(OPROS_LOAD_PRIMITIVE)
#undef OPROS_LOAD_PRIMITIVE
    virtual iarchive& load(std::string& value);
    virtual iarchive& load(std::wstring& value);
    virtual iarchive& load_binary(char** p, long& size);
    virtual iarchive& read_class_head(const std::string& name);
    virtual iarchive& read_container_name(const std::string& name);
    virtual std::size_t read_sequence_head();
    virtual long read_array_head(long size, char code, char bytes);
    virtual iarchive& read_array_end(long size, char code, char bytes);

  private:
    template <typename T>
    iarchive& get(char code, T& value);
    template <typename T>
    T get_bytes();
    void expect(char code);
    void get_blob(std::string& bytes);

    std::istream* m_is;
    bool m_bare; // inside an array of numbers, whose elements have no code
};

} // namespace archive
} // namespace opros

#endif
