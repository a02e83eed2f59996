// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <cstdlib>

/// The programmer's errors: on unless NDEBUG. The text says what to do instead. Off, the condition is compiled and not
/// evaluated, so that what it names counts as used.
#ifdef NDEBUG
#define KERF_ASSERT(condition, advice) static_cast<void>(sizeof((condition) ? 1 : 0))
#else
#define KERF_ASSERT(condition, advice)                                                                     \
    do {                                                                                                   \
        if (!(condition)) {                                                                                \
            std::fprintf(stderr, "%s:%d: %s does not hold: %s\n", __FILE__, __LINE__, #condition, advice); \
            std::abort();                                                                                  \
        }                                                                                                  \
    } while (false)
#endif
