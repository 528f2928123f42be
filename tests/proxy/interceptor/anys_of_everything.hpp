// SPDX-License-Identifier: Apache-2.0
// Anys of each type of IDL with extreme values, for tests of the transcoder and for the RTCs of the matrices.
#pragma once

#include "Types.hh"

#include <omniORB4/CORBA.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace tandem::test {

inline TestTypes::All all_kinds() {
    TestTypes::All all;
    all.first = 7;
    all.precise = 1.0L / 3;
    all.sign = L'\u00e9';
    all.title = CORBA::wstring_dup(L"caf\u00e9 \ud55c");
    all.state = TestTypes::fast;
    all.states.length(2);
    all.states[0] = TestTypes::slow;
    all.states[1] = TestTypes::off;
    all.order.speed(2.5);
    all.order._d(TestTypes::fast);
    all.mail.text("hello");
    all.mail._d('z');
    all.cost = TestTypes::Price("-123.45");
    all.content <<= CORBA::Double(0.25);
    all.secret.length(3);
    all.label = CORBA::string_dup("eight ch");
    for (int i = 0; i < 6; ++i) all.table[i / 3][i % 3] = i;
    return all;
}

template <class T>
CORBA::Any any_of(T value) {
    CORBA::Any any;
    any <<= value;
    return any;
}

/// Names an any by the typedef that it was made of.
template <class T>
CORBA::Any any_of(CORBA::TypeCode_ptr code, T value) {
    CORBA::Any any = any_of(value);
    any.type(code);
    return any;
}

template <class Union>
CORBA::Any any_of_case(const std::function<void(Union&)>& choose) {
    Union value;
    choose(value);
    return any_of(value);
}

struct NamedAny {
    const char* name;
    CORBA::Any any;
};

inline TestTypes::One one(CORBA::Long number) {
    TestTypes::One one;
    one.number = number;
    return one;
}

inline CORBA::Any any_of_all_kinds() {
    auto* all = new TestTypes::All;
    *all = all_kinds(); // unlike a copy, keeps the digits of a fixed
    CORBA::Any any;
    any <<= all;
    return any;
}

inline CORBA::Any any_of_holder() {
    TestTypes::Holder holder;
    holder.content <<= one(3);
    holder.last.number = 4;
    return any_of(holder);
}

inline std::vector<NamedAny> anys_of_everything() {
    using CORBA::Any;
    int no_arguments = 0;
    const CORBA::ORB_var orb = CORBA::ORB_init(no_arguments, nullptr);
    const CORBA::Object_var object = orb->string_to_object("corbaloc::127.0.0.1:9/nobody");
    const TestTypes::Thing_var thing = TestTypes::Thing::_unchecked_narrow(object);
    TestTypes::Singles singles;
    singles.length(2);
    TestTypes::Codes table;
    table[0] = CORBA::string_dup("eight ch");
    table[1] = CORBA::string_dup("");
    const CORBA::Any of_table = any_of(TestTypes::Codes_forany(table));
    return {
        {"null", Any()},
        {"boolean", any_of(Any::from_boolean(true))},
        {"char", any_of(Any::from_char('\xff'))},
        {"octet", any_of(Any::from_octet(255))},
        {"short", any_of(CORBA::Short(-32768))},
        {"unsigned short", any_of(CORBA::UShort(65535))},
        {"long", any_of(CORBA::Long(-2147483647 - 1))},
        {"unsigned long", any_of(CORBA::ULong(4294967295U))},
        {"long long", any_of(CORBA::LongLong(INT64_MIN))},
        {"unsigned long long", any_of(CORBA::ULongLong(UINT64_MAX))},
        {"float", any_of(CORBA::Float(1e38F))},
        {"double", any_of(CORBA::Double(-1e308))},
        {"long double", any_of(CORBA::LongDouble(1) / 3)},
        {"wchar", any_of(Any::from_wchar(0xffff))},
        {"string", any_of("text")},
        {"string of at most 8", any_of(Any::from_string("eight ch", 8))},
        {"wide string", any_of(Any::from_wstring(L"\uffff\u00e9", 0))},
        {"fixed", any_of(Any::from_fixed(TestTypes::Price("-12345.67"), 7, 2))},
        {"typedef of fixed",
         any_of(TestTypes::_tc_Price, Any::from_fixed(TestTypes::Price("-12345.67"), 7, 2))},
        {"any", any_of(any_of(one(5)))},
        {"enumeration", any_of(TestTypes::fast)},
        {"structure of one member", any_of(one(6))},
        {"typedef of a structure", any_of(TestTypes::_tc_Single, one(7))},
        {"structure of everything", any_of_all_kinds()},
        {"structure of references", any_of_holder()},
        {"sequence", any_of(singles)},
        {"array", of_table},
        {"union",
         any_of_case<TestTypes::Command>([](auto& value) { value.speed(2), value._d(TestTypes::fast); })},
        {"union of 64 bits", any_of_case<TestTypes::Wide>([](auto& value) { value.large("x"); })},
        {"union's default", any_of_case<TestTypes::Wide>([](auto& value) {
             value.least(one(8));
             value._d(9223372036854775808ULL);
         })},
        {"union of negative labels", any_of_case<TestTypes::Signed>([](auto& value) { value.low(1); })},
        {"union without a member", any_of_case<TestTypes::Flag>([](auto& value) { value._default(); })},
        {"reference", any_of(TestTypes::Thing_ptr(thing.in()))},
        {"object", any_of(CORBA::Object_ptr(object.in()))},
    };
}

/// Returns whether TypeCodes, including all names, and values are equal.
inline bool is_same_any(const CORBA::Any& a, const CORBA::Any& b) {
    const CORBA::TypeCode_var code = a.type(), other = b.type();
    if (!code->equal(other.in()) || !code->equivalent(other.in())) return false;
    int no_arguments = 0;
    const CORBA::ORB_var orb = CORBA::ORB_init(no_arguments, nullptr);
    const CORBA::Object_var object = orb->resolve_initial_references("DynAnyFactory");
    const DynamicAny::DynAnyFactory_var factory = DynamicAny::DynAnyFactory::_narrow(object);
    const DynamicAny::DynAny_var value = factory->create_dyn_any(a), other_value = factory->create_dyn_any(b);
    const bool same = value->equal(other_value);
    value->destroy();
    other_value->destroy();
    return same;
}

} // namespace tandem::test
