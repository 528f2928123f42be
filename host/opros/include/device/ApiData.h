// SPDX-License-Identifier: Apache-2.0
// Defines the data types of OPRoS v2 that consist of numbers. Ours.
#ifndef DEVICE_APIDATA_H_
#define DEVICE_APIDATA_H_

#include "ApiMembers.h"
#include "ApiValues.h"

/// Defines a class NAME with `status` (OPROS_SUCCESS unless set) and these numbers, which are 0 unless set.
#define OPROS_API_THREE_NUMBERS(name, a, b, c)                                                               \
    class name {                                                                                             \
      public:                                                                                                \
        ReturnType status = OPROS_SUCCESS;                                                                   \
        float64_t a = 0, b = 0, c = 0;                                                                       \
        name() {}                                                                                            \
        name(float64_t a##_, float64_t b##_, float64_t c##_) : a(a##_), b(b##_), c(c##_) {}                  \
        OPROS_API_MEMBERS(status, a, b, c)                                                                   \
    };                                                                                                       \
    OPROS_API_TYPE_NAME(name)

#define OPROS_API_SIX_NUMBERS(name, a, b, c, d, e, f)                                                        \
    class name {                                                                                             \
      public:                                                                                                \
        ReturnType status = OPROS_SUCCESS;                                                                   \
        float64_t a = 0, b = 0, c = 0, d = 0, e = 0, f = 0;                                                  \
        name() {}                                                                                            \
        name(float64_t a##_, float64_t b##_, float64_t c##_, float64_t d##_, float64_t e##_, float64_t f##_) \
            : a(a##_), b(b##_), c(c##_), d(d##_), e(e##_), f(f##_) {}                                        \
        OPROS_API_MEMBERS(status, a, b, c, d, e, f)                                                          \
    };                                                                                                       \
    OPROS_API_TYPE_NAME(name)

#define OPROS_API_NINE_NUMBERS(name, a, b, c, d, e, f, g, h, i)                                              \
    class name {                                                                                             \
      public:                                                                                                \
        ReturnType status = OPROS_SUCCESS;                                                                   \
        float64_t a = 0, b = 0, c = 0, d = 0, e = 0, f = 0, g = 0, h = 0, i = 0;                             \
        name() {}                                                                                            \
        name(float64_t a##_, float64_t b##_, float64_t c##_, float64_t d##_, float64_t e##_, float64_t f##_, \
             float64_t g##_, float64_t h##_, float64_t i##_)                                                 \
            : a(a##_), b(b##_), c(c##_), d(d##_), e(e##_), f(f##_), g(g##_), h(h##_), i(i##_) {}             \
        OPROS_API_MEMBERS(status, a, b, c, d, e, f, g, h, i)                                                 \
    };                                                                                                       \
    OPROS_API_TYPE_NAME(name)

#endif
