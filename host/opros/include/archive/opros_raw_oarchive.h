// SPDX-License-Identifier: Apache-2.0
// Values one after the other, without type information: numbers as their bytes in little endian, a block of bytes
// after its length. Both ends must know the types.
#ifndef OPROS_RAW_OARCHIVE_H
#define OPROS_RAW_OARCHIVE_H

#include <archive/opros_oarchive_stl.h>

#include <ostream>
#include <string>
#include <vector>

namespace opros {
namespace archive {

/// The shortest of the three formats, for two ends that agree on the types.
class raw_oarchive : public oarchive {
  public:
    /// The stream must outlive the archive. Its error flags show whether everything has been written.
    explicit raw_oarchive(std::ostream* os) : m_os(os) {}
    using oarchive::save;

#define OPROS_SAVE_PRIMITIVE(type) virtual oarchive& save(type value);
    OPROS_FOR_EACH_PRIMITIVE(OPROS_SAVE_PRIMITIVE)
#undef OPROS_SAVE_PRIMITIVE
    virtual oarchive& save(const std::string& value);
    virtual oarchive& save(const std::wstring& value);
    virtual oarchive& save_binary(const char* p, long size);
    virtual oarchive& write_sequence_head(std::size_t count);

  private:
    template <typename T>
    oarchive& put(T value);

    std::ostream* m_os;
};

} // namespace archive
} // namespace opros

#endif
