// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <cstdlib>

/// Aborts if `condition` is false, unless NDEBUG is defined. `advice` is the remedy. For errors of the programmer.
/// With NDEBUG the condition is compiled but not evaluated, so that its variables count as used.
#ifdef NDEBUG
#define KERF_ASSERT(condition, advice) static_cast<void>(sizeof((condition) ? 1 : 0))
#else
#define KERF_ASSERT(condition, advice)                                                                \
    do {                                                                                              \
        if (!(condition)) {                                                                           \
            std::fprintf(stderr, "%s:%d: %s is false: %s\n", __FILE__, __LINE__, #condition, advice); \
            std::abort();                                                                             \
        }                                                                                             \
    } while (false)
#endif
