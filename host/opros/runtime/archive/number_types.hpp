// SPDX-License-Identifier: Apache-2.0
// The types that every archive reads and writes in the same way: all primitives except bool and the character types.
#pragma once

/// Expands apply(TYPE) for each of these types. OPROS_FOR_EACH_PRIMITIVE (opros_oarchive.h) covers all primitives.
#define OPROS_FOR_EACH_NUMBER(apply)                                                                         \
    apply(short) apply(unsigned short) apply(int) apply(unsigned int) apply(long) apply(unsigned long)       \
        apply(long long) apply(unsigned long long) apply(float) apply(double) apply(long double)
