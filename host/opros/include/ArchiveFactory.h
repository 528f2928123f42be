// SPDX-License-Identifier: Apache-2.0
#ifndef ARCHIVEFACTORY_H_
#define ARCHIVEFACTORY_H_

#include <archive/opros_archive.h>

#include <sstream>

/// Makes the archives by which a port's data are encoded outside this host.
class ArchiveFactory {
  public:
    ArchiveFactory();
    virtual ~ArchiveFactory();
    virtual opros::archive::oarchive* getOutputArchive(std::ostream* str) = 0;
    virtual opros::archive::iarchive* getInputArchive(std::istream* str) = 0;
    virtual void release(opros::archive::oarchive* arc) = 0;
    virtual void release(opros::archive::iarchive* arc) = 0;
};

#endif
