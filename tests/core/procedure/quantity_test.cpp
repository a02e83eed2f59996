// SPDX-License-Identifier: Apache-2.0
#include "core/procedure/quantity.h"

#include <gtest/gtest.h>

#include <locale>
#include <string>
#include <string_view>
#include <utility>

#include "kerf/units.hpp"

namespace kerf {
namespace {

using namespace literals;

const QuantityNeed any_length{dimension::length, "mm", -10.0_m, 10.0_m};
const QuantityNeed any_number{dimension::none, "", -1000.0, 1000.0};

QuantityNeed need(kerf_dimension d, const char* unit) { return {d, unit, -1e12, 1e12}; }

double value(std::string_view text, const QuantityNeed& wanted) {
    const Parsed<double> parsed = parse_quantity(text, "it", wanted);
    EXPECT_TRUE(parsed.value) << text << ": " << parsed.problem.message;
    return parsed.value.value_or(-1e300);
}

QuantityProblem problem(std::string_view text, const QuantityNeed& wanted) {
    const Parsed<double> parsed = parse_quantity(text, "it", wanted);
    EXPECT_FALSE(parsed.value) << text;
    return parsed.problem;
}

QuantityProblem problem_of_vector(std::string_view text) {
    const Parsed<Vec3> parsed = parse_vector(text, "at", any_length);
    EXPECT_FALSE(parsed.value) << text;
    return parsed.problem;
}

TEST(Quantity, IsTheSameNumberAsTheLiteral) {
    EXPECT_EQ(value("3.2 mm", any_length), 3.2_mm);
    EXPECT_EQ(value("-5 mm", any_length), -(5.0_mm));
    EXPECT_EQ(value("1000 rpm", need(dimension::frequency, "rpm")), 1000.0_rpm);
    EXPECT_EQ(value("118 deg", need(dimension::angle, "deg")), 118.0_deg);
    EXPECT_EQ(value("1 mm/s", need(dimension::speed, "mm/s")), 1.0_mm_per_s);
    EXPECT_EQ(value("60 N", need(dimension::force, "N")), 60.0_N);
    EXPECT_EQ(value("150 ms", need(dimension::time, "ms")), 150.0_ms);
    EXPECT_EQ(value("1.85 g/cm3", need(dimension::density, "g/cm3")), 1.85_g_per_cm3);
    EXPECT_EQ(value("8 N/mm", need(dimension::force_per_length, "N/mm")), 8.0_N_per_mm);
    EXPECT_EQ(value("40 N/mm2", need(dimension::pressure, "N/mm2")), 40.0_N_per_mm2);
    EXPECT_EQ(value("12 Nmm", need(dimension::torque, "Nmm")), 12.0_Nmm);
}

TEST(Quantity, AcceptsTheUsualWaysToWriteAPower) {
    for (const char* text : {"1 N/mm2", "1 N/mm^2", "1 N/mm²", "1 MPa", "1N/mm2"})
        EXPECT_EQ(value(text, need(dimension::pressure, "MPa")), 1e6) << text;
}

TEST(Quantity, RevolutionsPerMinuteAreRevolutionsPerSecond) {
    EXPECT_EQ(value("60 rpm", need(dimension::frequency, "Hz")), 1.0);
    EXPECT_EQ(value("60 1/min", need(dimension::frequency, "Hz")), 1.0);
}

TEST(Quantity, APlainNumberMayBeAFraction) {
    EXPECT_EQ(value("1/50", any_number), 0.02);
    EXPECT_EQ(value("0.5", any_number), 0.5);
    EXPECT_EQ(problem("1/0", any_number).code, Code::not_a_number);
}

TEST(Quantity, WithoutItsUnitIsRefusedAndSaysWhatToWrite) {
    const QuantityProblem refused = problem("3.2", any_length);
    EXPECT_EQ(refused.code, Code::missing_unit);
    EXPECT_EQ(refused.write, "3.2 mm");
}

TEST(Quantity, OfAnotherDimensionIsRefused) {
    EXPECT_EQ(problem("3.2 s", any_length).code, Code::wrong_dimension);
    EXPECT_EQ(problem("3.2 mm", any_number).code, Code::wrong_dimension);
    EXPECT_EQ(problem("3.2 mm2", any_length).code, Code::wrong_dimension);
    EXPECT_EQ(problem("3 rad", need(dimension::frequency, "rpm")).code, Code::wrong_dimension);
}

TEST(Quantity, AMassInPlaceOfAForceIsAnsweredWithItsWeight) {
    const QuantityProblem refused = problem("10 kg", need(dimension::force, "N"));
    EXPECT_EQ(refused.code, Code::wrong_dimension);
    EXPECT_EQ(refused.write, "98 N");
}

TEST(Quantity, WithAnUnknownUnitIsRefused) {
    for (const char* text :
         {"3 furlong", "3 mm/", "3 /s", "3 mm//s", "3 mm mm mm mm mm mm mm", "3 MM", "0x10 mm", "3 mm0"})
        EXPECT_EQ(problem(text, any_length).code, Code::unknown_unit) << text;
}

TEST(Quantity, ThatIsNoNumberIsRefused) {
    for (const char* text : {"", "mm", "inf mm", "nan mm", "1e400 mm", "--3 mm", "+3 mm", "-", ".", "-inf", "three mm"})
        EXPECT_EQ(problem(text, any_length).code, Code::not_a_number) << text;
}

TEST(Quantity, ADecimalCommaIsRefusedWithThePointToWrite) {
    const QuantityProblem refused = problem("3,2 mm", any_length);
    EXPECT_EQ(refused.code, Code::not_a_number);
    EXPECT_EQ(refused.write, "3.2 mm");
}

TEST(Quantity, ACommaBeforeThreeDigitsMayMeanThousandsSoBothAreSaid) {
    const QuantityProblem refused = problem("1,000 mm", any_length);
    EXPECT_EQ(refused.code, Code::not_a_number);
    EXPECT_EQ(refused.message, "it is `1,000 mm`, but a number has a decimal point, not a comma. Write `1000 mm` for "
                               "thousands, or `1.000 mm`.");
    EXPECT_EQ(refused.write, "");
}

struct DecimalComma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
};

TEST(Quantity, DoesNotDependOnTheLocale) {
    const std::locale before = std::locale::global(std::locale(std::locale::classic(), new DecimalComma));
    EXPECT_EQ(value("3.2 mm", any_length), 3.2_mm);
    EXPECT_EQ(quantity_text(0.5_mm, "mm"), "0.5 mm");
    std::locale::global(before);
}

TEST(Quantity, OutOfRangeNamesTheRangeAndTheSlippedPoint) {
    const QuantityNeed diameter{dimension::length, "mm", 0.5_mm, 20.0_mm};
    const Parsed<double> parsed = parse_quantity("65 mm", "drill.diameter", diameter);
    EXPECT_EQ(parsed.problem.code, Code::out_of_range);
    EXPECT_EQ(parsed.problem.message, "drill.diameter is 65 mm, must be 0.5 mm … 20 mm.");
    EXPECT_EQ(parsed.problem.write, "6.5 mm");
}

TEST(Quantity, OutOfRangeIsAnsweredInTheUnitItWasWrittenInWithAValueThatWouldBeRead) {
    const QuantityNeed diameter{dimension::length, "mm", 0.5_mm, 20.0_mm};
    EXPECT_EQ(problem("-3.2 mm", diameter).write, "3.2 mm");
    EXPECT_EQ(problem("-3200 um", diameter).message, "it is -3200 um, must be 500 um … 20000 um.");
    EXPECT_EQ(problem("-3200 um", diameter).write, "3200 um");

    const QuantityNeed angle{dimension::angle, "deg", 60.0_deg, 160.0_deg};
    EXPECT_EQ(problem("0.4 rad", angle).message, "it is 0.4 rad, must be 60 deg … 160 deg.")
        << "no one reads 1.047197551 rad";
    EXPECT_EQ(problem("0.4 rad", angle).write, "60 deg");
    for (const auto& [text, need] : {std::pair{"-3.2 mm", diameter},
                                     {"0 mm", diameter},
                                     {"-1 m", diameter},
                                     {"7 cm", diameter},
                                     {"1e9 um", diameter},
                                     {"0.4 rad", angle},
                                     {"-7 rad", angle},
                                     {"3 rad", angle},
                                     {"1 deg", angle}}) {
        const std::string write = problem(text, need).write;
        EXPECT_TRUE(parse_quantity(write, "it", need).value) << text << " → " << write;
    }
}

TEST(Quantity, AtTheEndOfItsRangeIsAllowedInEveryUnit) {
    const QuantityNeed diameter{dimension::length, "mm", 0.1_mm, 20.0_mm};
    for (const char* text : {"0.1 mm", "100 um", "0.0001 m", "0.01 cm", "20 mm", "2 cm"})
        EXPECT_TRUE(parse_quantity(text, "it", diameter).value) << text;
}

TEST(Vector, IsThreeNumbersAndOneUnit) {
    const Parsed<Vec3> parsed = parse_vector("3.0 193.0 -60.5 mm", "at", any_length);
    ASSERT_TRUE(parsed.value);
    EXPECT_TRUE(*parsed.value == (Vec3{3.0_mm, 193.0_mm, -(60.5_mm)}));
}

TEST(Vector, ADirectionHasNoUnit) {
    const Parsed<Vec3> parsed = parse_vector("0 0 1", "up", any_number);
    ASSERT_TRUE(parsed.value);
    EXPECT_TRUE(*parsed.value == (Vec3{0, 0, 1}));
}

TEST(Vector, WithTooFewOrTooManyNumbersIsRefused) {
    for (const char* text : {"1 2 mm", "1 2 3 4 mm", "1, 2, 3 mm", "", "mm"})
        EXPECT_EQ(parse_vector(text, "at", any_length).problem.code, Code::not_three_numbers) << text;
    EXPECT_EQ(parse_vector("1 2 3", "at", any_length).problem.code, Code::missing_unit);
}

TEST(Vector, WithCommasIsAnsweredWithoutThem) {
    EXPECT_EQ(problem_of_vector("1, 2, 3 mm").write, "1 2 3 mm");
    EXPECT_EQ(problem_of_vector("0,5 0 -0,5 mm").write, "0.5 0 -0.5 mm");
    EXPECT_EQ(problem_of_vector("left of the canal").message,
              "at is `left of the canal`, must be three numbers and one unit, as in `1 2 3 mm`. Write it so.");
}

TEST(QuantityText, IsShort) {
    EXPECT_EQ(quantity_text(20.0_mm, "mm"), "20 mm");
    EXPECT_EQ(quantity_text(118.0_deg, "deg"), "118 deg");
    EXPECT_EQ(quantity_text(0.25, ""), "0.25");
}

}  // namespace
}  // namespace kerf
