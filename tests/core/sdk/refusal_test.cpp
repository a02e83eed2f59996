// SPDX-License-Identifier: Apache-2.0
#include "kerf/refusal.hpp"

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

TEST(Refusal, SaysItsPiecesInOrder) {
    kerf_tool_shape shape{};
    EXPECT_EQ(refuse(&shape, "`a` is ", in_mm(0.003), std::string("; it needs "), in_mm(0.004), "."),
              KERF_OUT_OF_RANGE);
    EXPECT_STREQ(shape.refusal, "`a` is 3 mm; it needs 4 mm.");
}

TEST(Refusal, OfWhatIsTooLongTheEndIsCutOff) {
    kerf_tool_shape shape{};
    (void)refuse(&shape, std::string(200, 'a'), std::string(200, 'b'), "c");
    EXPECT_EQ(std::string(shape.refusal), std::string(200, 'a') + std::string(39, 'b'));
}

}  // namespace
}  // namespace kerf
