// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/adaptor/archive/type_check.hpp"
#include "proxy/adaptor/typed/codec.hpp"
#include "proxy/wire/type.hpp"

#include <EventData.h>
#include <OPRoSTypes.h>

#include <memory>
#include <string>
#include <vector>

namespace tandem::adaptor {

/// A C++ type whose values cross, for code that has them only as opros_any. [any-thread]
class ValueType {
  public:
    virtual ~ValueType() = default;

    const std::string name; ///< the name from opros_any::type()
    const wire::Type type;

    virtual opros_any sample() const = 0;
    /// Encodes `value`, which has this type. Throws archive_type_exception for a string with a NUL.
    virtual void encode(opros_any& value, wire::CdrWriter& out) const = 0;
    /// Decodes into a value of this type. Throws archive_type_exception if the bytes are not such a value.
    virtual void decode(opros_any& value, wire::CdrReader& in) const = 0;
    /// Encodes an argument of a call; returns false if it has another type. Throws as encode().
    virtual bool encode_param(opros_params& value, wire::CdrWriter& out) const = 0;
    virtual opros_params decode_param(wire::CdrReader& in) const = 0;
    /// Copies from CDR to an archive, and back. Throw the archive's exceptions and archive_type_exception.
    virtual void save(wire::CdrReader& from, opros::archive::oarchive& to) const = 0;
    virtual void load(opros::archive::iarchive& from, wire::CdrWriter& to) const = 0;
    /// Returns a new event with such a value.
    virtual std::unique_ptr<Event> make_event() const = 0;

  protected:
    ValueType(std::string type_name, wire::Type wire_type)
        : name(std::move(type_name)), type(std::move(wire_type)) {}
};

/// Returns the type of a Codec's signature.
template <class T>
wire::Type wire_type() {
    wire::Type message = wire::parse_signature(Codec<T>::signature());
    return message.children.size() == 1 ? message.children.front() : message;
}

template <class T>
class ValueTypeOf final : public ValueType {
  public:
    ValueTypeOf() : ValueType(opros_any(T()).type(), wire_type<T>()) {}

    opros_any sample() const override { return opros_any(T()); }
    void encode(opros_any& value, wire::CdrWriter& out) const override {
        Codec<T>::encode(*unsafe_opros_any_cast<T>(&value), out);
    }
    void decode(opros_any& value, wire::CdrReader& in) const override {
        decode_checked(*unsafe_opros_any_cast<T>(&value), in);
    }
    bool encode_param(opros_params& value, wire::CdrWriter& out) const override {
        const T* held = opros_params_cast<T>(&value);
        if (held) Codec<T>::encode(*held, out);
        return held != nullptr;
    }
    opros_params decode_param(wire::CdrReader& in) const override {
        T value{};
        decode_checked(value, in);
        return opros_params(value);
    }
    void save(wire::CdrReader& from, opros::archive::oarchive& to) const override {
        T value{};
        decode_checked(value, from);
        to << value;
    }
    void load(opros::archive::iarchive& from, wire::CdrWriter& to) const override {
        T value{};
        from >> value;
        Codec<T>::encode(value, to);
    }
    std::unique_ptr<Event> make_event() const override {
        auto event = std::make_unique<EventData<T>>();
        event->setContentData(T());
        return event;
    }

  private:
    static void decode_checked(T& value, wire::CdrReader& in) {
        Codec<T>::decode(value, in);
        if (!in.ok()) throw opros::archive::archive_type_exception();
    }
};

using ValueTypes = std::vector<std::unique_ptr<const ValueType>>;

/// A std::unique_ptr of each class would take longer to compile than the class.
template <class T>
void add_value_type(ValueTypes& types) {
    types.emplace_back(new ValueTypeOf<T>());
}

/// Returns the type of this name on ports; nullptr if it does not cross.
const ValueType* find_value_type(const std::string& name);
/// Returns the default type for an IDL type; nullptr if there is none.
const ValueType* find_value_type(const wire::Type& type);
/// Returns the type of the content of such events; nullptr if it does not cross.
const ValueType* find_content_type(Event& event);

/// Calls check_type(), and also refuses types that begin with RTM's time, which does not cross in this engine.
TypeCheck check_typed(const opros_any& sample, const link::Port& peer, bool sends,
                      const std::string& convert);

/// Adds the types of the user's header, after all others.
void add_users_values(ValueTypes& types);

} // namespace tandem::adaptor
