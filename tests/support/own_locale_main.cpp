// SPDX-License-Identifier: Apache-2.0
// Runs tests as in a program that has set the locale of its user: numbers with a comma, or an i whose capital has a
// dot.
#include <gtest/gtest.h>

#include <clocale>
#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    const char* wanted = std::getenv("LC_ALL");
    const char* set = std::setlocale(LC_ALL, "");
    if (wanted != nullptr && *wanted != '\0' && set == nullptr) {
        std::fprintf(stderr, "there is no locale %s here\n", wanted);
        return 1;
    }
    char number[16];
    std::snprintf(number, sizeof number, "%.1f", 0.5);
    std::printf("locale %s: a half is %s\n", set, number);
    return RUN_ALL_TESTS();
}
