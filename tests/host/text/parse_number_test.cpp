// SPDX-License-Identifier: Apache-2.0
#include "host/text/parse_number.hpp"

#include "tests/support/comma_locale.hpp"

using tandem::text::parse_number;

TEST_CASE("a number is the whole text, in the forms that strtod takes") {
    CHECK(parse_number("0.5") == 0.5);
    CHECK(parse_number("-1e3") == -1000);
    CHECK(parse_number(" +7") == 7);
    CHECK(parse_number("0x10") == 16);
    for (const char* text : {"", "fast", "0,5", "1.5 m", "5 "}) CHECK_FALSE(parse_number(text));
}

TEST_CASE("a number has a decimal point when a component has set a locale with a decimal comma") {
    const tandem::test::CommaLocale locale;
    CHECK(parse_number("0.5") == 0.5);
    CHECK_FALSE(parse_number("0,5"));
}
