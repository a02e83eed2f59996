// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <locale.h>

#include <clocale>

namespace kerf::text {

/// While an object of this class lives, the C library reads and writes numbers on this thread with a decimal point. The
/// program's locale does not matter: a library in the program, or a program around Kerf, may have set a decimal comma.
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

}  // namespace kerf::text
