// SPDX-License-Identifier: Apache-2.0
// A library that is loaded before the program and sets a locale, as a user interface or a driver may.
#include <clocale>
#include <cstdlib>

[[gnu::constructor]] void set_locale() {
    if (const char* wanted = std::getenv("KERF_SETS_LOCALE"); wanted != nullptr) std::setlocale(LC_ALL, wanted);
}
