// SPDX-License-Identifier: Apache-2.0
// The self-describing binary format of OPRoS. A primitive is a type code, its size in bytes and its bytes in little
// endian. A class is 'T', the length of its type name in 16 bits, and the name.
#ifndef OPROS_BINARY_OARCHIVE_H
#define OPROS_BINARY_OARCHIVE_H

#include <archive/opros_binary.h>
#include <archive/opros_oarchive_stl.h>

#include <ostream>

namespace opros {
namespace archive {

/// For values that must be checked when they are read: each contains its type.
class binary_oarchive : public oarchive {
  public:
    /// The stream must outlive the archive. Its error flags show whether everything has been written.
    explicit binary_oarchive(std::ostream* os) : oarchive(true), m_os(os), m_bare(false) {}
    using oarchive::save;

#define OPROS_SAVE_PRIMITIVE(type) virtual oarchive& save(type value);
    OPROS_FOR_EACH_PRIMITIVE(OPROS_SAVE_PRIMITIVE)
#undef OPROS_SAVE_PRIMITIVE
    virtual oarchive& save(const std::string& value);
    virtual oarchive& save(const std::wstring& value);
    virtual oarchive& save_binary(const char* p, long size);
    virtual oarchive& write_class_head(const std::string& name);
    virtual oarchive& write_container_name(const std::string& name);
    virtual oarchive& write_sequence_head(std::size_t count);
    virtual oarchive& write_array_head(long size, char code, char bytes);
    virtual oarchive& write_array_end(long size, char code, char bytes);

  private:
    template <typename T>
    oarchive& put(char code, T value);
    template <typename T>
    void put_bytes(T value);

    std::ostream* m_os;
    bool m_bare; // inside an array, whose elements have no code
};

} // namespace archive
} // namespace opros

#endif
