// SPDX-License-Identifier: Apache-2.0
#include "kerf/figure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>

namespace kerf {
namespace {

std::string text_of(const Figure& figure) { return std::string(static_cast<std::string_view>(figure)); }

TEST(Figure, HasThreeDigitsAndItsUnit) {
    EXPECT_EQ(text_of(in_mm(0.00096137)), "0.961 mm");
    EXPECT_EQ(text_of(Figure(2.5)), "2.5");
    EXPECT_EQ(text_of(Figure(-1.0e-300, " kg mm2")), "-1e-300 kg mm2");
    EXPECT_EQ(text_of(Figure(std::nan(""), " deg")), "nan deg");
}

}  // namespace
}  // namespace kerf
