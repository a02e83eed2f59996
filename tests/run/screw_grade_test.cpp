// SPDX-License-Identifier: Apache-2.0
#include "run/screw_grade.h"

#include <gtest/gtest.h>

#include <utility>

#include "kerf/units.hpp"

namespace kerf {
namespace {

using namespace literals;

TEST(ScrewGrade, StepsAtTwoFourAndSixMillimetres) {
    for (const auto& [breach, grade] : {std::pair<double, const char*>{0.0, "A"},
                                        {0.01_mm, "B"},
                                        {1.99_mm, "B"},
                                        {2.0_mm, "C"},
                                        {3.99_mm, "C"},
                                        {4.0_mm, "D"},
                                        {6.0_mm, "E"},
                                        {30.0_mm, "E"}})
        EXPECT_EQ(gertzbein_robbins(breach, breach), grade) << breach;
}

TEST(ScrewGrade, GivesBothWhereTheBreachDecidesNeither) {
    EXPECT_EQ(gertzbein_robbins(1.9_mm, 2.1_mm), "B/C");
    EXPECT_EQ(gertzbein_robbins(0.0, 0.1_mm), "A/B");
    EXPECT_EQ(gertzbein_robbins(2.1_mm, 2.3_mm), "C");
}

}  // namespace
}  // namespace kerf
