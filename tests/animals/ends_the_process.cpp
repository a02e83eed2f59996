// SPDX-License-Identifier: Apache-2.0
// A library whose static constructor does not come back. Which way it goes is chosen where it is built.
#include <csignal>
#include <cstdlib>
#include <stdexcept>

namespace {

struct Constructed {
    Constructed() {
#if defined(KERF_aborts)
        std::abort();
#elif defined(KERF_crashes)
        std::raise(SIGSEGV);
#elif defined(KERF_exits)
        std::exit(0);
#elif defined(KERF_throws)
        throw std::runtime_error("not today");
#endif
    }
} constructed;

}  // namespace
