// SPDX-License-Identifier: Apache-2.0
#ifndef OPROS_RAW_IARCHIVE_H
#define OPROS_RAW_IARCHIVE_H

#include <archive/opros_iarchive_stl.h>

#include <istream>
#include <string>
#include <vector>

namespace opros {
namespace archive {

/// Reads the format of raw_oarchive. Throws an archive exception if bytes are missing.
class raw_iarchive : public iarchive {
  public:
    /// The stream must be seekable and outlive the archive.
    explicit raw_iarchive(std::istream* is) : m_is(is) {}
    using iarchive::load;

#define OPROS_LOAD_PRIMITIVE(type) virtual iarchive& load(type& value);
    OPROS_FOR_EACH_PRIMITIVE(OPROS_LOAD_PRIMITIVE)
#undef OPROS_LOAD_PRIMITIVE
    virtual iarchive& load(std::string& value);
    virtual iarchive& load(std::wstring& value);
    virtual iarchive& load_binary(char** p, long& size);
    virtual std::size_t read_sequence_head();

  private:
    template <typename T>
    iarchive& get(T& value);
    void get_blob(std::string& bytes);

    std::istream* m_is;
};

} // namespace archive
} // namespace opros

#endif
