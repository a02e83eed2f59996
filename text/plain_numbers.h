// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <locale.h>

#include <clocale>

namespace kerf {

/// While this lives, the C library writes and reads numbers on this thread with a decimal point, whatever the locale of
/// the program: a library that is linked into it, or a program that Kerf is linked into, may have set one with a comma.
/// [any]
class PlainNumbers {
public:
    PlainNumbers() : before_(uselocale(plain())) {}
    ~PlainNumbers() { uselocale(before_); }
    PlainNumbers(const PlainNumbers&) = delete;
    PlainNumbers& operator=(const PlainNumbers&) = delete;

private:
    static locale_t plain() {
        static const locale_t made = newlocale(LC_ALL_MASK, "C", nullptr);
        return made;
    }
    locale_t before_;
};

}  // namespace kerf
