// SPDX-License-Identifier: Apache-2.0
#ifndef METHODINVOKEEXCEPTION_H_
#define METHODINVOKEEXCEPTION_H_

#include <OPRoSTypes.h>

#include <exception>
#include <string>
#include <utility>
#include <vector>

namespace opros {

/// The fields of a MethodInvokeException with an id (ours).
class exception_fields {
  public:
    virtual ~exception_fields() {}
    virtual exception_fields* clone() const = 0;
    /// Assigns the fields, in order, to values of their types. Returns false if number or types differ.
    virtual bool read(std::vector<opros_params>& values) const = 0;
    /// Returns the values, or NULL if they came encoded across a link.
    virtual const std::vector<opros_params>* values() const { return 0; }
};

namespace detail {

class exception_values : public exception_fields {
  public:
    template <typename... Fields>
    explicit exception_values(int, const Fields&... fields) : m_values{opros_params(fields)...} {}
    virtual exception_fields* clone() const { return new exception_values(*this); }
    virtual bool read(std::vector<opros_params>& to) const {
        if (to.size() != m_values.size()) return false;
        for (std::size_t i = 0; i < to.size(); ++i)
            if (to[i].type() != m_values[i].type()) return false;
        to = m_values;
        return true;
    }
    virtual const std::vector<opros_params>* values() const { return &m_values; }

  private:
    std::vector<opros_params> m_values;
};

} // namespace detail
} // namespace opros

/// A service call could not be made, or the service has thrown an exception with an id. A call fails if the method is
/// not connected, the arguments have other types, the connection has failed, or too many calls wait. A callback may
/// let this exception pass: in onExecute and onUpdated it is logged and the component stays ACTIVE.
class MethodInvokeException : public std::exception {
  public:
    explicit MethodInvokeException(const std::string& message) : m_message(message), m_fields(0) {}
    /// An exception that the service's IDL declares (ours): its repository id, `IDL:Chair/TooFast:1.0`, and its
    /// fields in the order of the IDL. Across a link, the caller gets this exception.
    template <typename... Fields>
    MethodInvokeException(const std::string& message, const std::string& id, const Fields&... fields)
        : m_message(message), m_id(id), m_fields(new opros::detail::exception_values(0, fields...)) {}
    MethodInvokeException(const MethodInvokeException& other)
        : std::exception(other), m_message(other.m_message), m_id(other.m_id),
          m_fields(other.m_fields ? other.m_fields->clone() : 0) {}
    MethodInvokeException& operator=(const MethodInvokeException& other) {
        MethodInvokeException copy(other);
        m_message.swap(copy.m_message);
        m_id.swap(copy.m_id);
        std::swap(m_fields, copy.m_fields);
        return *this;
    }
    virtual ~MethodInvokeException() noexcept { delete m_fields; }
    /// Returns such an exception with encoded fields, of which it keeps a clone (ours, for bridges).
    static MethodInvokeException withFields(const std::string& message, const std::string& id,
                                            const opros::exception_fields& fields) {
        MethodInvokeException exception(message);
        exception.m_id = id;
        exception.m_fields = fields.clone();
        return exception;
    }

    std::string& getMessage() { return m_message; }
    /// Returns the repository id (ours). For a failed call across a link, returns the id of the CORBA system
    /// exception that describes the failure, `IDL:omg.org/CORBA/TIMEOUT:1.0`. Empty if there is none.
    const std::string& getId() const { return m_id; }
    /// Assigns the fields, in order, to variables of their types (ours). Returns false, without assigning any, if
    /// there are no fields of these types.
    template <typename... Fields>
    bool getFields(Fields&... fields) const {
        std::vector<opros_params> values{opros_params(fields)...};
        if (!m_fields || !m_fields->read(values)) return false;
        std::size_t index = 0;
        const int in_order[] = {0, (fields = *unsafe_opros_params_cast<Fields>(&values[index++]), 0)...};
        static_cast<void>(in_order);
        return true;
    }
    /// Returns the fields, or NULL if there are none (ours).
    const opros::exception_fields* fields() const { return m_fields; }
    virtual const char* what() const noexcept { return m_message.c_str(); }

  private:
    std::string m_message;
    std::string m_id;
    opros::exception_fields* m_fields; // owned
};

#endif
