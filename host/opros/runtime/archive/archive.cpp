// SPDX-License-Identifier: Apache-2.0
#include <ArchiveFactory.h>
#include <archive/opros_archive.h>

namespace opros::archive {

// The defaults of the functions for elements of one type: one by one. Archives that can copy whole arrays, as the
// proxy's CDR archives do, override them.

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

} // namespace opros::archive

// Here, so that the class has its virtual table in this library only.
ArchiveFactory::ArchiveFactory() = default;
ArchiveFactory::~ArchiveFactory() = default;
