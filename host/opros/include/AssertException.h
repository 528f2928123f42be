// SPDX-License-Identifier: Apache-2.0
#ifndef ASSERTEXCEPTION_H_
#define ASSERTEXCEPTION_H_

#include <exception>
#include <iostream>

/// Upstream's exception for failed assertions. This host does not throw it.
class AssertException : public std::exception {
  public:
    virtual const char* what() const noexcept { return "assertion failed"; }
    /// Writes what() to standard error.
    void message() const { std::cerr << what() << std::endl; }
};

#endif
