// SPDX-License-Identifier: Apache-2.0
// Values as text. A primitive is its type code, its value in decimal and ';'. A class is T[name], its members and
// ';'. An array is A[count], its elements and ';'. A block of bytes is G[count], the bytes and ';'.
#ifndef OPROS_STRING_OARCHIVE_H
#define OPROS_STRING_OARCHIVE_H

#include <archive/opros_oarchive_stl.h>

#include <ostream>
#include <string>
#include <vector>

namespace opros {
namespace archive {

/// For values that people read, as in logs and tools. Writes floating point with all digits.
class string_oarchive : public oarchive {
  public:
    /// In mode 1, numbers are 'X' and their bytes in hexadecimal.
    explicit string_oarchive(std::ostream* os, int mode = 0)
        : oarchive(true), m_os(os), m_hexadecimal(mode != 0), m_named(false) {}
    using oarchive::save;

#define OPROS_SAVE_PRIMITIVE(type) virtual oarchive& save(type value);
    OPROS_FOR_EACH_PRIMITIVE(OPROS_SAVE_PRIMITIVE)
#undef OPROS_SAVE_PRIMITIVE
    virtual oarchive& save(const std::string& value);
    virtual oarchive& save(const std::wstring& value);
    virtual oarchive& save_binary(const char* p, long size);
    virtual oarchive& write_sequence_head(std::size_t count);
    virtual oarchive& write_class_head(const std::string& name);
    virtual oarchive& write_class_end(const std::string& name);
    virtual oarchive& write_container_name(const std::string& name);
    virtual oarchive& write_sequence_end();
    virtual oarchive& write_array_head(long size, char code, char bytes);
    virtual oarchive& write_array_end(long size, char code, char bytes);

  private:
    template <typename T>
    oarchive& put(char code, T value);

    std::ostream* m_os;
    bool m_hexadecimal;
    bool m_named;               // the next sequence is a container
    std::vector<bool> m_inside; // for each open sequence: whether it is a container
};

} // namespace archive
} // namespace opros

#endif
