// SPDX-License-Identifier: Apache-2.0
#ifndef ARGUMENTNUMBEREXCEPTION_H_
#define ARGUMENTNUMBEREXCEPTION_H_

#include <exception>
#include <sstream>
#include <string>

/// A method was called with the wrong number of arguments.
class ArgumentNumberException : public std::exception {
  public:
    /// `arity` is the method's number of arguments. The line, which upstream's constructor takes, is not used.
    ArgumentNumberException(int /*line*/, int arity) {
        std::ostringstream text;
        text << "function requires " << arity << " arguments";
        m_message = text.str();
    }
    std::string& getMessage() { return m_message; }
    virtual const char* what() const noexcept { return m_message.c_str(); }

  private:
    std::string m_message;
};

#endif
