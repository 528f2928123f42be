// SPDX-License-Identifier: Apache-2.0
#ifndef ARGUMENTNUMBEREXCEPTION_H_
#define ARGUMENTNUMBEREXCEPTION_H_

#include <exception>
#include <sstream>
#include <string>

/// A method was called with another number of arguments than it has.
class ArgumentNumberException : public std::exception {
  public:
    /// `arity`: the number of arguments that the method has. The line of upstream's constructor is not used.
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
