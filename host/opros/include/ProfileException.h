// SPDX-License-Identifier: Apache-2.0
#ifndef PROFILEEXCEPTION_H_
#define PROFILEEXCEPTION_H_

#include <exception>
#include <string>

/// Upstream's exception, for components that throw or catch it. This host does not throw it.
class ProfileException : public std::exception {
  public:
    explicit ProfileException(const std::string& message) : m_message(message) {}
    std::string& getMessage() { return m_message; }
    virtual const char* what() const noexcept { return m_message.c_str(); }

  private:
    std::string m_message;
};

#endif
