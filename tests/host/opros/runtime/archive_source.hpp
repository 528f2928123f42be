// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <DataPortSource.h>

/// A source whose values are read by archives.
class ArchiveSource : public DataPortSource {
  public:
    /// Reads the oldest value; nullptr: there is none.
    virtual opros::archive::iarchive* next() = 0;
    /// The value of the last next() has been read or dropped.
    virtual void done() = 0;

    bool take(opros_any* value) override {
        opros::archive::iarchive* const archive = next();
        if (!archive) return false;
        const struct AtEnd {
            ~AtEnd() { source.done(); } // also when decoding throws
            ArchiveSource& source;
        } at_end{*this};
        if (value) value->decode(*archive);
        return true;
    }
};
