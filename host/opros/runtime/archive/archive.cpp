// SPDX-License-Identifier: Apache-2.0
#include <ArchiveFactory.h>
#include <archive/opros_archive.h>

namespace opros::archive {

namespace {

template <class T>
void load_elements_of(iarchive& in, std::vector<T>& values) {
    in.load_array(values.data(), static_cast<long>(values.size()));
}
void load_elements_of(iarchive& in, std::vector<bool>& values) {
    for (std::vector<bool>::reference bit : values) in >> bit;
}

} // namespace

// Default implementations for arrays: element by element. Archives that can copy whole arrays, such as the proxy's
// CDR archives, override them.

#define OPROS_SAVE_ELEMENTS(type)                                                                            \
    oarchive& oarchive::save_array(const type* p, long size) {                                               \
        for (long i = 0; i < size; ++i) save(p[i]);                                                          \
        return *this;                                                                                        \
    }
OPROS_FOR_EACH_PRIMITIVE(OPROS_SAVE_ELEMENTS)

#define OPROS_LOAD_ELEMENTS(type)                                                                            \
    iarchive& iarchive::load_array(type* p, long size) {                                                     \
        for (long i = 0; i < size; ++i) load(p[i]);                                                          \
        return *this;                                                                                        \
    }
OPROS_FOR_EACH_PRIMITIVE(OPROS_LOAD_ELEMENTS)

#define OPROS_SEQUENCE(type)                                                                                 \
    oarchive& oarchive::save_sequence(const type* p, std::size_t count) {                                    \
        write_sequence_head(count);                                                                          \
        save_array(p, static_cast<long>(count));                                                             \
        return write_sequence_end();                                                                         \
    }                                                                                                        \
    iarchive& iarchive::load_sequence(std::vector<type>& values) {                                           \
        values.resize(read_sequence_head());                                                                 \
        load_elements_of(*this, values);                                                                     \
        return read_sequence_end();                                                                          \
    }
OPROS_FOR_EACH_PRIMITIVE(OPROS_SEQUENCE)

} // namespace opros::archive

// Defined here so that only this library contains the class's virtual table.
ArchiveFactory::ArchiveFactory() = default;
ArchiveFactory::~ArchiveFactory() = default;
