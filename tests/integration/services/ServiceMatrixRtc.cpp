// SPDX-License-Identifier: Apache-2.0
// Provides every operation of the matrix twice on one port, requires it on the same port, and calls what it requires
// once somebody provides it.
#include "../rtm/register_rtc.hpp"
#include "MatrixSkel.h"
#include "tests/proxy/interceptor/anys_of_everything.hpp"

#include "MatrixCells.h"
#include "cells.h"

#include <rtm/CorbaConsumer.h>
#include <rtm/CorbaPort.h>
#include <rtm/DataFlowComponentBase.h>
#include <rtm/Manager.h>

#include <atomic>
#include <cstring>
#include <limits>

namespace {

// ---- values of a seed; opros_values.h has the same

/// The lowest number for a third of the seeds, the highest for another third. The sign of a character does not matter.
template <class T>
void set(T& value, int seed) {
    using Limits = std::numeric_limits<T>;
    const bool lowest = seed % 3 == 0, highest = seed % 3 == 1;
    if constexpr (sizeof(T) == 1)
        value = static_cast<T>(lowest ? 0x80 : highest ? 0xff : seed);
    else if constexpr (Limits::is_integer)
        value = lowest ? Limits::min() : highest ? Limits::max() : static_cast<T>(seed);
    else
        value = lowest ? Limits::lowest() : highest ? Limits::max() : static_cast<T>(seed) / 4;
}
void set(CORBA::Boolean& value, int seed) { value = seed % 2 != 0; }
void set(CORBA::WChar& value, int seed) { value = seed % 3 == 0 ? 0xffff : seed; }
/// Also the values of the type `fixed<6, 2>`.
std::string text(int seed) {
    return seed % 3 == 0 ? "-9999.99" : seed % 3 == 1 ? "9999.99" : std::to_string(seed) + ".25";
}
void set(Matrix::Mode& value, int seed) { value = static_cast<Matrix::Mode>(seed % 3); }
void set(Matrix::Price& value, int seed) { value = CORBA::Fixed(text(seed).c_str()); }
void set(char*& value, int seed) {
    CORBA::string_free(value);
    value = CORBA::string_dup(text(seed).c_str());
}
void set(CORBA::String_out value, int seed) { value = CORBA::string_dup(text(seed).c_str()); }
void set(CORBA::String_var& value, int seed) { value = CORBA::string_dup(text(seed).c_str()); }
void set(CORBA::String_member& value, int seed) { value = CORBA::string_dup(text(seed).c_str()); }
std::wstring wide_text(int seed) {
    return std::wstring(static_cast<std::size_t>(seed % 4), seed % 2 == 0 ? L'\uffff' : L'\u00e9');
}
CORBA::WChar* new_wide_text(int seed) { return CORBA::wstring_dup(wide_text(seed).c_str()); }
void set(CORBA::WChar*& value, int seed) {
    CORBA::wstring_free(value);
    value = new_wide_text(seed);
}
void set(CORBA::WString_out value, int seed) { value = new_wide_text(seed); }
void set(CORBA::WString_var& value, int seed) { value = new_wide_text(seed); }
void set(CORBA::WString_member& value, int seed) { value = new_wide_text(seed); }
void set(_CORBA_String_element value, int seed) { value = CORBA::string_dup(text(seed).c_str()); }
void set(Matrix::Point& value, int seed) {
    value.x = seed + 0.25;
    for (int i = 0; i < 3; ++i) value.grid[i] = seed + i;
}
void set(Matrix::Label& value, int seed) {
    set(value.text, seed);
    set(value.place, seed);
    value.valid = seed % 2 != 0;
}
void set(Matrix::Choice& value, int seed) {
    const int kind = seed % 4;
    CORBA::Double number = 0;
    set(number, seed);
    if (kind == 0) value.number(number);
    if (kind == 1) value.text(text(seed).c_str());
    if (kind < 2) return;
    Matrix::Point place;
    set(place, seed);
    value.place(place);
    value._d(kind); // 2 and 3 select the same member
}
void set(CORBA::Any& any, int seed) { any <<= CORBA::Double(seed + 0.25); }
void set(Matrix::Weights& weights, int seed) {
    weights.length(static_cast<CORBA::ULong>(seed % 3));
    for (CORBA::ULong i = 0; i < weights.length(); ++i) {
        weights[i].key = std::string(1, static_cast<char>('a' + i)).c_str();
        weights[i].value = seed + static_cast<int>(i);
    }
}
void set(Matrix::Settings& settings, int seed) {
    settings.length(static_cast<CORBA::ULong>(seed % 3));
    for (CORBA::ULong i = 0; i < settings.length(); ++i) {
        settings[i].name = std::string(1, static_cast<char>('a' + i)).c_str();
        settings[i].value = std::to_string(seed).c_str();
    }
}
void set(Matrix::Doubles& values, int seed);
template <class Sequence>
void set_sequence(Sequence& values, int seed) {
    values.length(static_cast<CORBA::ULong>(seed % 3));
    for (CORBA::ULong i = 0; i < values.length(); ++i) {
        auto&& value = values[i];
        set(value, seed + static_cast<int>(i));
    }
}
void set(Matrix::Octets& values, int seed) { set_sequence(values, seed); }
void set(Matrix::Doubles& values, int seed) { set_sequence(values, seed); }
void set(Matrix::Strings& values, int seed) { set_sequence(values, seed); }
void set(Matrix::Labels& values, int seed) { set_sequence(values, seed); }
void set(Matrix::Rows& values, int seed) { set_sequence(values, seed); }
#define MATRIX_VARIABLE(type)                                                                                \
    void set(type##_out values, int seed) { set(*values.ptr(), seed); }                                      \
    void set(type##_var& values, int seed) {                                                                 \
        values = new type;                                                                                   \
        set(values.inout(), seed);                                                                           \
    }                                                                                                        \
    void clear(type##_var&) {}
MATRIX_VARIABLE(Matrix::Label)
MATRIX_VARIABLE(Matrix::Choice)
MATRIX_VARIABLE(Matrix::Octets)
MATRIX_VARIABLE(Matrix::Doubles)
MATRIX_VARIABLE(Matrix::Strings)
MATRIX_VARIABLE(Matrix::Labels)
MATRIX_VARIABLE(Matrix::Rows)
MATRIX_VARIABLE(Matrix::Weights)
MATRIX_VARIABLE(Matrix::Settings)
MATRIX_VARIABLE(CORBA::Any)
template <class T>
void clear(T& value) {
    set(value, 98);
}
void clear(CORBA::String_var&) {}
void clear(CORBA::WString_var&) {}

bool same(const char* value, int seed) { return text(seed) == value; }
bool same(char* const& value, int seed) { return text(seed) == value; }
template <class T>
bool same(const T& value, int seed) {
    T expected{};
    set(expected, seed);
    return value == expected;
}
bool same(const CORBA::String_var& value, int seed) { return same(value.in(), seed); }
bool same(const CORBA::String_member& value, int seed) { return same(value.in(), seed); }
bool same(const CORBA::WChar* value, int seed) { return wide_text(seed) == value; }
bool same(CORBA::WChar* const& value, int seed) { return wide_text(seed) == value; }
bool same(const CORBA::WString_var& value, int seed) { return same(value.in(), seed); }
bool same(const CORBA::WString_member& value, int seed) { return same(value.in(), seed); }
bool same(const CORBA::Any& any, int seed) {
    CORBA::Double number = 0;
    return (any >>= number) && number == seed + 0.25;
}
bool same(const Matrix::Weights& weights, int seed) {
    Matrix::Weights expected;
    set(expected, seed);
    if (weights.length() != expected.length()) return false;
    for (CORBA::ULong i = 0; i < weights.length(); ++i)
        if (std::strcmp(weights[i].key, expected[i].key) != 0 || weights[i].value != expected[i].value)
            return false;
    return true;
}
bool same(const Matrix::Settings& settings, int seed) {
    Matrix::Settings expected;
    set(expected, seed);
    if (settings.length() != expected.length()) return false;
    for (CORBA::ULong i = 0; i < settings.length(); ++i)
        if (std::strcmp(settings[i].name, expected[i].name) != 0 ||
            std::strcmp(settings[i].value, expected[i].value) != 0)
            return false;
    return true;
}
bool same(const Matrix::Point& value, int seed) {
    Matrix::Point expected;
    set(expected, seed);
    return value.x == expected.x && std::memcmp(value.grid, expected.grid, sizeof value.grid) == 0;
}
bool same(const Matrix::Label& value, int seed) {
    return same(value.text, seed) && same(value.place, seed) && value.valid == (seed % 2 != 0);
}
bool same(const Matrix::Choice& value, int seed) {
    const int kind = seed % 4;
    if (value._d() != kind) return false;
    CORBA::Double number = 0;
    set(number, seed);
    if (kind == 0) return value.number() == number;
    return kind == 1 ? same(value.text(), seed) : same(value.place(), seed);
}
bool same(const Matrix::Doubles& values, int seed);
template <class Sequence>
bool same_sequence(const Sequence& values, int seed) {
    if (values.length() != static_cast<CORBA::ULong>(seed % 3)) return false;
    for (CORBA::ULong i = 0; i < values.length(); ++i)
        if (!same(values[i], seed + static_cast<int>(i))) return false;
    return true;
}
bool same(const Matrix::Octets& values, int seed) { return same_sequence(values, seed); }
bool same(const Matrix::Doubles& values, int seed) { return same_sequence(values, seed); }
bool same(const Matrix::Strings& values, int seed) {
    if (values.length() != static_cast<CORBA::ULong>(seed % 3)) return false;
    for (CORBA::ULong i = 0; i < values.length(); ++i)
        if (!same(static_cast<const char*>(values[i]), seed + static_cast<int>(i))) return false;
    return true;
}
bool same(const Matrix::Labels& values, int seed) { return same_sequence(values, seed); }
bool same(const Matrix::Rows& values, int seed) { return same_sequence(values, seed); }
#define MATRIX_SAME(type)                                                                                    \
    bool same(const type##_var& values, int seed) { return same(values.in(), seed); }
MATRIX_SAME(Matrix::Label)
MATRIX_SAME(Matrix::Choice)
MATRIX_SAME(Matrix::Octets)
MATRIX_SAME(Matrix::Doubles)
MATRIX_SAME(Matrix::Strings)
MATRIX_SAME(Matrix::Labels)
MATRIX_SAME(Matrix::Rows)
MATRIX_SAME(Matrix::Weights)
MATRIX_SAME(Matrix::Settings)
MATRIX_SAME(CORBA::Any)

/// A value to be returned, as the C++ mapping wants it: a pointer for what is not of fixed length.
template <class T>
struct Maker {
    static T make(int seed) {
        T value{};
        set(value, seed);
        return value;
    }
};
template <class T>
struct Maker<T*> {
    static T* make(int seed) {
        auto* value = new T;
        set(*value, seed);
        return value;
    }
};
template <>
struct Maker<char*> {
    static char* make(int seed) { return CORBA::string_dup(text(seed).c_str()); }
};
template <>
struct Maker<CORBA::WChar*> {
    static CORBA::WChar* make(int seed) { return new_wide_text(seed); }
};
template <class T>
T made(int seed) {
    return Maker<T>::make(seed);
}

/// An attribute's value, to be returned.
template <class R, class T>
R copied(const T& value) {
    if constexpr (std::is_same_v<R, char*>)
        return CORBA::string_dup(value.in());
    else if constexpr (std::is_same_v<R, CORBA::WChar*>)
        return CORBA::wstring_dup(value.in());
    else if constexpr (std::is_pointer_v<R>)
        return new T(value);
    else
        return value;
}

std::string what() {
    try {
        throw;
    } catch (const CORBA::Exception& error) {
        return error._rep_id();
    } catch (const std::exception& error) {
        return error.what();
    }
}

const std::vector<tandem::test::NamedAny>& anys() {
    static const auto all = tandem::test::anys_of_everything();
    return all;
}

#include "MatrixServant.h"

#include "MatrixCalls.h"

} // namespace

class ServiceMatrixRtc : public RTC::DataFlowComponentBase {
  public:
    explicit ServiceMatrixRtc(RTC::Manager* manager) : RTC::DataFlowComponentBase(manager), port_("matrix") {}

    RTC::ReturnCode_t onInitialize() override {
        port_.registerProvider("first", "Matrix::Service", first_);
        port_.registerProvider("second", "Matrix::Service", second_);
        port_.registerConsumer("third", "Matrix::Service", required_);
        addPort(port_);
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        if (done_ || required_._ptr()->_non_existent()) return RTC::RTC_OK;
        done_ = true;
        Cells cells("RTM to OPRoS", what);
        call_all(required_._ptr(), cells);
        cells.print();
        return RTC::RTC_OK;
    }

  private:
    RTC::CorbaPort port_;
    MatrixServant first_, second_;
    RTC::CorbaConsumer<Matrix::Service> required_;
    bool done_ = false;
};

extern "C" void ServiceMatrixRtcInit(RTC::Manager* manager) {
    register_rtc<ServiceMatrixRtc>(manager, "ServiceMatrixRtc");
}
