// SPDX-License-Identifier: Apache-2.0
#ifndef ARCHIVEFACTORY_H_
#define ARCHIVEFACTORY_H_

#include <archive/opros_archive.h>

#include <sstream>

/// Creates the archives that encode a port's data outside this host. setArchiveFactory() passes it to a port. The
/// port's pushData(), pushEvent() and marshal() are not supported without one.
class ArchiveFactory {
  public:
    ArchiveFactory();
    virtual ~ArchiveFactory();
    /// Returns an archive that writes to, or reads from, the stream. The stream must outlive the archive. The caller
    /// returns the archive with release(). [any-thread]
    virtual opros::archive::oarchive* getOutputArchive(std::ostream* str) = 0;
    virtual opros::archive::iarchive* getInputArchive(std::istream* str) = 0;
    virtual void release(opros::archive::oarchive* arc) = 0;
    virtual void release(opros::archive::iarchive* arc) = 0;
};

#endif
