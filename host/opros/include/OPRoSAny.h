// SPDX-License-Identifier: Apache-2.0
// A value of any type, as ports pass it. Ours: part of OPRoSTypes.h, which components include.
#ifndef OPROS_ANY_H_
#define OPROS_ANY_H_

#include <archive/opros_archive.h>

#include <cstddef>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <vector>

/// Holds a copy of one value of any copyable type, or nothing. Not thread-safe.
class opros_any {
  public:
    /// The content of an opros_any, and all operations that do not need its type.
    class holder_base {
      public:
        virtual ~holder_base() {}
        // Stored instead of returned by virtual functions: each message needs both several times.
        const std::type_info& rtti() const { return *m_type; }
        /// Returns the address of the value.
        const void* address() const { return m_address; }
        virtual const std::string type() const = 0;
        /// Returns a new holder with a copy of the value.
        virtual holder_base* clone() const = 0;
        /// Assigns the other's value to this one. Returns false if the types differ.
        virtual bool assign(const holder_base& other) = 0;
        virtual bool serializable() const = 0;
        virtual void encode(opros::archive::oarchive& ar) const = 0;
        virtual void decode(opros::archive::iarchive& ar) = 0;

        // For a std::vector of numbers, so that a bridge can copy them without an archive.
        /// Returns the size of an element in bytes, or 0 for any other type.
        unsigned int elementBytes() const { return m_elementBytes; }
        /// The memory of the elements.
        struct Memory {
            void* begin;
            std::size_t bytes;
        };
        virtual Memory elements() const = 0;
        /// Resizes the vector to `count` elements.
        virtual Memory resize(std::size_t count) = 0;

      protected:
        holder_base(const std::type_info& type, const void* address, unsigned int elementBytes)
            : m_type(&type), m_address(address), m_elementBytes(elementBytes) {}

      private:
        holder_base(const holder_base&);
        holder_base& operator=(const holder_base&);
        const std::type_info* m_type;
        const void* m_address;
        unsigned int m_elementBytes;
    };

    opros_any() : content(0) {}
    template <typename dataType>
    opros_any(const dataType& value) : content(new holder<dataType>(value)) {}
    opros_any(const opros_any& other) : content(other.content ? other.content->clone() : 0) {}
    virtual ~opros_any() { delete content; }

    /// Exchanges the values without copying them.
    opros_any& swap(opros_any& other) {
        std::swap(content, other.content);
        return *this;
    }
    template <typename dataType>
    opros_any& operator=(const dataType& value) {
        opros_any(value).swap(*this);
        return *this;
    }
    /// Copies into the existing value if the types are the same, which reuses the value's storage.
    opros_any& operator=(const opros_any& other) {
        if (this == &other) return *this;
        if (content && other.content && content->assign(*other.content)) return *this;
        opros_any(other).swap(*this);
        return *this;
    }

    bool empty() const { return !content; }
    /// Ours, for bridges: returns the content, or NULL if empty. For use where one function per type would cost too
    /// much for each message.
    holder_base* held() { return content; }
    /// Returns the type's name on ports (typeName), or "void" if empty.
    const std::string type() const { return content ? content->type() : std::string("void"); }

    /// Returns true if encode() and decode() work: the type has save and load in one of the known ways.
    bool serializable() const { return content && content->serializable(); }
    /// Writes the value. An empty object writes nothing. Throws archive_type_exception unless serializable().
    void encode(opros::archive::oarchive& ar) const {
        if (content) content->encode(ar);
    }
    /// Reads a value of the held type in place. Throws like encode(), and the exceptions of the archive.
    void decode(opros::archive::iarchive& ar) {
        if (content) content->decode(ar);
    }

    /// Returns true if it holds a dataType: the same C++ type, or one with the same name on ports.
    template <typename dataType>
    bool holds() const {
        return content && (&content->rtti() == &typeid(dataType) || holdsByName<dataType>());
    }

  protected:
    template <typename dataType>
    class holder;
    /// For libraries that do not share the type's type_info.
    template <typename dataType>
    bool holdsByName() const {
        return content->rtti() == typeid(dataType) || content->type() == getTypeName<dataType>();
    }
    /// Takes ownership of the holder.
    explicit opros_any(holder_base* taken, int) : content(taken) {}
    holder_base* content;

    template <typename dataType>
    friend dataType* unsafe_opros_any_cast(opros_any*);
    friend class opros_any_view;
};

namespace opros {
namespace detail {

// Types that cannot be archived still work on ports inside one host.
template <typename T, bool serializable>
struct codec {
    static void encode(archive::oarchive& ar, const T& value) { ar << value; }
    static void decode(archive::iarchive& ar, T& value) { ar >> value; }
};
template <typename T>
struct codec<T, false> {
    static void encode(archive::oarchive&, const T&) { throw archive::archive_type_exception(); }
    static void decode(archive::iarchive&, T&) { throw archive::archive_type_exception(); }
};

/// Vectors of numbers whose bytes are their value, which archives copy as one block.
template <typename T>
struct numbers {
    typedef opros_any::holder_base::Memory memory;
    static const unsigned int element_bytes = 0;
    static memory of(T&) { return memory(); }
    static memory resize(T&, std::size_t) { return memory(); }
};
template <typename T>
struct is_number
    : std::integral_constant<bool, std::is_arithmetic<T>::value && !std::is_same<T, bool>::value &&
                                       !std::is_same<T, wchar_t>::value && sizeof(T) <= 8> {};
template <typename T, bool is_number>
struct numbers_of_vector {
    typedef opros_any::holder_base::Memory memory;
    static const unsigned int element_bytes = sizeof(T);
    static memory of(std::vector<T>& value) {
        const memory found = {value.data(), value.size() * sizeof(T)};
        return found;
    }
    static memory resize(std::vector<T>& value, std::size_t count) {
        value.resize(count);
        return of(value);
    }
};
template <typename T>
struct numbers_of_vector<T, false> {
    typedef opros_any::holder_base::Memory memory;
    static const unsigned int element_bytes = 0;
    static memory of(std::vector<T>&) { return memory(); }
    static memory resize(std::vector<T>&, std::size_t) { return memory(); }
};
template <typename T>
struct numbers<std::vector<T>> : numbers_of_vector<T, is_number<T>::value> {};

/// The part of a holder that depends only on the type, whether it holds the value or refers to it.
template <typename T>
class typed_holder : public opros_any::holder_base {
  public:
    static const bool can_cross = archive::is_serializable<T>::value;
    explicit typed_holder(const T* value)
        : opros_any::holder_base(typeid(T), value, numbers<T>::element_bytes) {}
    virtual opros_any::holder_base::Memory elements() const { return numbers<T>::of(value()); }
    virtual opros_any::holder_base::Memory resize(std::size_t count) {
        return numbers<T>::resize(value(), count);
    }
    virtual const std::string type() const { return getTypeName<T>(); }
    virtual bool assign(const opros_any::holder_base& other) {
        if (&other.rtti() != &typeid(T) && other.rtti() != typeid(T)) return false;
        value() = *static_cast<const T*>(other.address());
        return true;
    }
    virtual bool serializable() const { return can_cross; }
    virtual void encode(archive::oarchive& ar) const {
        codec<T, can_cross>::encode(ar, *static_cast<const T*>(address()));
    }
    virtual void decode(archive::iarchive& ar) { codec<T, can_cross>::decode(ar, value()); }

  private:
    T& value() const { return *static_cast<T*>(const_cast<void*>(address())); }
};

} // namespace detail
} // namespace opros

template <typename dataType>
class opros_any::holder : public opros::detail::typed_holder<dataType> {
  public:
    explicit holder(const dataType& value)
        : opros::detail::typed_holder<dataType>(&m_value), m_value(value) {}
    virtual opros_any::holder_base* clone() const { return new holder(m_value); }

  private:
    dataType m_value;
};

/// An opros_any that refers to a caller's value during one call, so that a push needs neither a copy nor an
/// allocation. Copies of it are ordinary and have their own value.
class opros_any_view {
  public:
    template <typename dataType>
    class of : public opros_any {
      public:
        explicit of(const dataType& value) : opros_any(), m_reference(value) { content = &m_reference; }
        ~of() { content = 0; }

      private:
        of(const of&);
        of& operator=(const of&);
        class reference : public opros::detail::typed_holder<dataType> {
          public:
            explicit reference(const dataType& value) : opros::detail::typed_holder<dataType>(&value) {}
            virtual opros_any::holder_base* clone() const {
                return new opros_any::holder<dataType>(*static_cast<const dataType*>(this->address()));
            }
        };
        reference m_reference;
    };
};

/// Returns the value without a check. The operand must hold a dataType.
template <typename dataType>
dataType* unsafe_opros_any_cast(opros_any* operand) {
    return static_cast<dataType*>(const_cast<void*>(operand->content->address()));
}
template <typename dataType>
const dataType* unsafe_opros_any_cast(const opros_any* operand) {
    return unsafe_opros_any_cast<dataType>(const_cast<opros_any*>(operand));
}
/// Returns NULL unless the operand holds a dataType.
template <typename dataType>
dataType* opros_any_cast(opros_any* operand) {
    return operand && operand->holds<dataType>() ? unsafe_opros_any_cast<dataType>(operand) : 0;
}
template <typename dataType>
const dataType* opros_any_cast(const opros_any* operand) {
    return opros_any_cast<dataType>(const_cast<opros_any*>(operand));
}
/// Returns a copy. Throws std::bad_cast unless the operand holds a dataType.
template <typename dataType>
dataType opros_any_cast(opros_any& operand) {
    dataType* value = opros_any_cast<dataType>(&operand);
    if (!value) throw std::bad_cast();
    return *value;
}

// Upstream's names for the casts.
#define SAFE_CASTING(a, b) (static_cast<a>(b))
#define ANY_CASTING(a, b) (opros_any_cast<a>(b))
#define UNSAFE_ANY_CASTING(a, b) (unsafe_opros_any_cast<a>(b))

#endif
