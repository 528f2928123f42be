// SPDX-License-Identifier: Apache-2.0
#ifndef METHODINVOKEEXCEPTION_H_
#define METHODINVOKEEXCEPTION_H_

#include <exception>
#include <string>

/// A service call could not be made: the method is not connected, the arguments have other types, the connection has
/// failed, or too many calls wait. A callback may let it pass through: in onExecute and onUpdated it is logged and the
/// component stays ACTIVE.
class MethodInvokeException : public std::exception {
  public:
    explicit MethodInvokeException(const std::string& message) : m_message(message) {}
    std::string& getMessage() { return m_message; }
    virtual const char* what() const noexcept { return m_message.c_str(); }

  private:
    std::string m_message;
};

#endif
