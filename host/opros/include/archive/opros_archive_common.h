// SPDX-License-Identifier: Apache-2.0
// Shared by both archive directions: errors, name-value pairs, type codes.
#ifndef OPROS_ARCHIVE_COMMON_H
#define OPROS_ARCHIVE_COMMON_H

#include <archive/opros_type_info.h>
#include <archive/opros_type_traits.h>

#include <cstddef>
#include <exception>
#include <string>

// Type codes in the binary and the text format. Signed and unsigned types have the same code.
#define BOOL_CODE 'Z'
#define SHORT_CODE 'i'
#define UNSIGNED_SHORT_CODE 'i'
#define INT_CODE 'I'
#define UNSIGNED_INT_CODE 'I'
#define LONG_CODE 'L'
#define UNSIGNED_LONG_CODE 'L'
#define LONG_LONG_CODE 'S'
#define UNSIGNED_LONG_LONG_CODE 'S'
#define FLOAT_CODE 'F'
#define DOUBLE_CODE 'd'
#define LONG_DOUBLE_CODE 'D'
#define CHAR_CODE 'C'
#define SIGNED_CHAR_CODE 'C'
#define UNSIGNED_CHAR_CODE 'C'
#define WCHAR_T_CODE 'w'
#define ARRAY_CODE 'A'
#define CLASS_CODE 'T'
#define BINARY_CODE 'G'
#define SIZE_CODE_MAX 16

// The version that every save() and load() gets. There is only one.
#define OPROS_SERIALIZATION_VERSION 1
// A member with its name, for save() or load(): ar << OPROS_SERIALIZATION_NVP(x).
#define OPROS_SERIALIZATION_NVP(a) opros::makenvp(#a, a)
#define OPROS_SERIALIZATION_MAKE_NVP(a, b) opros::makenvp(#a, b)

namespace opros {
namespace archive {

class oarchive;
class iarchive;

/// Base class of the archives of both directions.
class archive {
  public:
    virtual ~archive() {}
    /// Returns true if the archive needs the names of classes and members; otherwise they are not created. Not
    /// virtual: each container in a message calls it.
    bool keeps_names() const { return m_keepsNames; }

  protected:
    explicit archive(bool keepsNames = false) : m_keepsNames(keepsNames) {}

  private:
    bool m_keepsNames;
};

/// The bytes hold a type other than the requested one, or the type cannot be archived at all.
class archive_type_exception : public std::exception {
  public:
    virtual const char* what() const noexcept { return "archive type mismatch error"; }
};
/// The number of elements exceeds the caller's space or what the bytes can hold.
class archive_array_size_exception : public std::exception {
  public:
    virtual const char* what() const noexcept { return "array size mismatch"; }
};
/// Upstream's exception. This implementation does not throw it.
class archive_system_exception : public std::exception {
  public:
    virtual const char* what() const noexcept { return "system error"; }
};
/// The bytes are not of this format, or end early.
class archive_format_exception : public std::exception {
  public:
    virtual const char* what() const noexcept { return "archive format error"; }
};

/// Returns the code of the pointer's type, or CLASS_CODE if it is not a primitive.
template <typename T>
inline char type_code(T*) {
    return CLASS_CODE;
}
inline char type_code(bool*) { return BOOL_CODE; }
inline char type_code(short*) { return SHORT_CODE; }
inline char type_code(unsigned short*) { return UNSIGNED_SHORT_CODE; }
inline char type_code(int*) { return INT_CODE; }
inline char type_code(unsigned int*) { return UNSIGNED_INT_CODE; }
inline char type_code(long*) { return LONG_CODE; }
inline char type_code(unsigned long*) { return UNSIGNED_LONG_CODE; }
inline char type_code(long long*) { return LONG_LONG_CODE; }
inline char type_code(unsigned long long*) { return UNSIGNED_LONG_LONG_CODE; }
inline char type_code(float*) { return FLOAT_CODE; }
inline char type_code(double*) { return DOUBLE_CODE; }
inline char type_code(long double*) { return LONG_DOUBLE_CODE; }
inline char type_code(char*) { return CHAR_CODE; }
inline char type_code(signed char*) { return SIGNED_CHAR_CODE; }
inline char type_code(unsigned char*) { return UNSIGNED_CHAR_CODE; }
inline char type_code(wchar_t*) { return WCHAR_T_CODE; }

} // namespace archive

/// Base class of all name-value pairs, by which components recognize them.
class nvp_base {};

/// A value with its name in its class. Only archives that keep names use the name.
template <typename Type>
class nvp : public nvp_base {
  public:
    /// Refers to both arguments, which must outlive the pair.
    nvp(const char* name, Type& data) : m_name(name), m_data(&data) {}
    std::string getName() const { return m_name; }
    Type& getData() const { return *m_data; }

  private:
    const char* m_name;
    Type* m_data;
};

/// Returns a pair for a member; see OPROS_SERIALIZATION_NVP.
template <typename T>
inline nvp<T> makenvp(const char* name, T& value) {
    return nvp<T>(name, value);
}

} // namespace opros

#endif
