// SPDX-License-Identifier: Apache-2.0
// tandem rtm inject accepts the output of tandem rtm cat.
#include "apps/tandem/rtm/stream/cdr_json_converter.hpp"

#include <catch2/catch.hpp>

using tandem::command::CdrJsonConverter;
using tandem::command::DataConversionError;
using tandem::command::Json;

namespace {

struct Converter {
    CORBA::ORB_var orb;
    CdrJsonConverter converter{make_orb().in()};

    CORBA::ORB_var& make_orb() {
        int count = 0;
        char* arguments[] = {nullptr};
        orb = CORBA::ORB_init(count, arguments);
        return orb;
    }
    Json there_and_back(CORBA::TypeCode_ptr type, const Json& value) {
        return converter.to_json(type, converter.to_cdr(type, value, GENERATE(true, false)));
    }

    // union (enum Leg), (long) ...; each has a member for the first label, a wide text for the second.
    CORBA::TypeCode_var union_of(CORBA::TypeCode_ptr discriminator, const CORBA::Any& first,
                                 const CORBA::Any& second, bool has_default) {
        CORBA::UnionMemberSeq members;
        const auto add = [&](const char* name, const CORBA::Any& label, CORBA::TypeCode_ptr type) {
            const CORBA::ULong i = members.length();
            members.length(i + 1);
            members[i].name = CORBA::string_dup(name);
            members[i].label = label;
            members[i].type = CORBA::TypeCode::_duplicate(type);
        };
        add("number", first, CORBA::_tc_double);
        add("text", second, CORBA::_tc_wstring);
        if (has_default) {
            CORBA::Any label;
            label <<= CORBA::Any::from_octet(0);
            add("other", label, CORBA::_tc_wchar);
        }
        return orb->create_union_tc("IDL:Choice:1.0", "Choice", discriminator, members);
    }
};

CORBA::Any label_of(CORBA::Long number) {
    CORBA::Any label;
    label <<= number;
    return label;
}

} // namespace

TEST_CASE("wide text is UTF-8 in JSON") {
    Converter test;
    CORBA::StructMemberSeq members;
    members.length(2);
    members[0].name = CORBA::string_dup("text");
    members[0].type = CORBA::TypeCode::_duplicate(CORBA::_tc_wstring);
    members[1].name = CORBA::string_dup("letter");
    members[1].type = CORBA::TypeCode::_duplicate(CORBA::_tc_wchar);
    const CORBA::TypeCode_var type = test.orb->create_struct_tc("IDL:Label:1.0", "Label", members);
    for (const char* text : {"", "plain", "h\u00e9 \u6b69\uffff"}) {
        const Json json{{"text", text}, {"letter", "\u6b69"}};
        CHECK(test.there_and_back(type, json) == json);
    }
    const Json empty{{"text", ""}, {"letter", ""}}; // a NUL
    CHECK(test.there_and_back(type, empty) == empty);
    for (const auto& [value, error] :
         {std::pair<Json, const char*>{"\U0001f600", "is not UTF-8 text with characters up to"},
          {"\xff", "is not UTF-8"},
          {7, "7 has a different type"}})
        CHECK_THROWS_WITH(test.converter.to_cdr(type, {{"text", value}}, true),
                          Catch::StartsWith("Label.text: ") && Catch::Contains(error));
}

TEST_CASE("a union is its case and the member that the case selects") {
    Converter test;
    const auto open = test.union_of(CORBA::_tc_long, label_of(-3), label_of(7), false);
    CHECK(test.there_and_back(open, {{"case", -3}, {"number", 1.5}}) == Json{{"case", -3}, {"number", 1.5}});
    CHECK(test.there_and_back(open, {{"case", 7}, {"text", "\u6b69"}}) ==
          Json{{"case", 7}, {"text", "\u6b69"}});
    CHECK(test.there_and_back(open, {{"case", 8}}) == Json{{"case", 8}});
    const auto closed = test.union_of(CORBA::_tc_long, label_of(0), label_of(1), true);
    CHECK(test.there_and_back(closed, {{"case", 0}}) == Json{{"case", 0}, {"number", 0.0}});
    CHECK(test.there_and_back(closed, {{"case", 9}, {"other", "x"}}) == Json{{"case", 9}, {"other", "x"}});
    CHECK_THROWS_WITH(test.converter.to_cdr(open, {{"case", 7}, {"number", 1}}, true),
                      Catch::Contains("case 7 selects member text, not number"));
    CHECK_THROWS_WITH(test.converter.to_cdr(open, {{"case", 8}, {"number", 1}}, true),
                      Catch::Contains("case 8 selects no member, not number"));
    CHECK_THROWS_WITH(test.converter.to_cdr(open, {{"number", 1}}, true),
                      Catch::Contains("expected {\"case\": LABEL"));
}

TEST_CASE("the case of a union over an enum is the enumerator's name") {
    Converter test;
    CORBA::EnumMemberSeq names;
    names.length(2);
    names[0] = CORBA::string_dup("left");
    names[1] = CORBA::string_dup("right");
    const CORBA::TypeCode_var side = test.orb->create_enum_tc("IDL:Side:1.0", "Side", names);
    CORBA::Object_var factory_object = test.orb->resolve_initial_references("DynAnyFactory");
    DynamicAny::DynAnyFactory_var factory = DynamicAny::DynAnyFactory::_narrow(factory_object);
    const auto label = [&](const char* name) {
        DynamicAny::DynAny_var value = factory->create_dyn_any_from_type_code(side);
        DynamicAny::DynEnum_var(DynamicAny::DynEnum::_narrow(value))->set_as_string(name);
        const CORBA::Any_var any = value->to_any();
        return CORBA::Any(any.in());
    };
    const auto type = test.union_of(side, label("left"), label("right"), false);
    CHECK(test.there_and_back(type, {{"case", "right"}, {"text", "b"}}) ==
          Json{{"case", "right"}, {"text", "b"}});
    CHECK(test.there_and_back(type, {{"case", 0U}, {"number", 2}}) ==
          Json{{"case", "left"}, {"number", 2.0}});
    CHECK_THROWS_WITH(test.converter.to_cdr(type, {{"case", "up"}}, true),
                      Catch::Contains("is not a value of Side"));
}
