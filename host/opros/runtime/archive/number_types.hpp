// SPDX-License-Identifier: Apache-2.0
// The types that every archive reads and writes in the same way: all primitives but bool and the characters.
#pragma once

/// apply(TYPE) for each of them. OPROS_FOR_EACH_PRIMITIVE (opros_oarchive.h) has the others as well.
#define OPROS_FOR_EACH_NUMBER(apply)                                                                         \
    apply(short) apply(unsigned short) apply(int) apply(unsigned int) apply(long) apply(unsigned long)       \
        apply(long long) apply(unsigned long long) apply(float) apply(double) apply(long double)
