// SPDX-License-Identifier: Apache-2.0
#ifndef ARCHIVEFACTORY_H_
#define ARCHIVEFACTORY_H_

#include <archive/opros_archive.h>

#include <sstream>

/// Makes the archives by which a port's data are encoded outside this host. Given to a port with
/// setArchiveFactory(); the port's pushData(), pushEvent() and marshal() use it, and are not supported without one.
class ArchiveFactory {
  public:
    ArchiveFactory();
    virtual ~ArchiveFactory();
    /// [any-thread] An archive that writes to, or reads from, the stream, which must outlive it. The caller gives it
    /// back with release().
    virtual opros::archive::oarchive* getOutputArchive(std::ostream* str) = 0;
    virtual opros::archive::iarchive* getInputArchive(std::istream* str) = 0;
    virtual void release(opros::archive::oarchive* arc) = 0;
    virtual void release(opros::archive::iarchive* arc) = 0;
};

#endif
