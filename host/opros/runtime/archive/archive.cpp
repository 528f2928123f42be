// SPDX-License-Identifier: Apache-2.0
#include <ArchiveFactory.h>
#include <archive/opros_archive.h>

namespace opros::archive {

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

ArchiveFactory::ArchiveFactory() = default;
ArchiveFactory::~ArchiveFactory() = default;
