// SPDX-License-Identifier: Apache-2.0
#ifndef METHODINVOKEEXCEPTION_H_
#define METHODINVOKEEXCEPTION_H_

#include <exception>
#include <string>

/// A service call could not be made: no peer, wrong types, or the connection has failed.
class MethodInvokeException : public std::exception {
  public:
    explicit MethodInvokeException(const std::string& message) : m_message(message) {}
    std::string& getMessage() { return m_message; }
    virtual const char* what() const noexcept { return m_message.c_str(); }

  private:
    std::string m_message;
};

#endif
