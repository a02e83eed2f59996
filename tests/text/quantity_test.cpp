// SPDX-License-Identifier: Apache-2.0
#include "text/quantity.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>
#include <locale>
#include <regex>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "kerf/units.hpp"
#include "text/codes.h"

namespace kerf::text {
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

/// The exponents of length, mass, time and angle, as SI writes them.
kerf_dimension product(std::initializer_list<std::pair<kerf_dimension, int>> factors) {
    kerf_dimension all{};
    for (const auto& [dimension, power] : factors)
        for (int i = 0; i < 8; ++i)
            all.exponent[i] = static_cast<std::int8_t>(all.exponent[i] + power * dimension.exponent[i]);
    return all;
}

TEST(Unit, ASlashDividesByTheNextFactorAlone) {
    const auto unit = parse_unit("N/m*s"), other = parse_unit("N*s/m"), divided = parse_unit("N/m/s");
    ASSERT_TRUE(unit && other && divided);
    EXPECT_TRUE(unit->dimension == product({{dimension::force, 1}, {dimension::length, -1}, {dimension::time, 1}}));
    EXPECT_TRUE(unit->dimension == other->dimension);
    EXPECT_TRUE(divided->dimension == product({{dimension::force, 1}, {dimension::length, -1}, {dimension::time, -1}}));
}

TEST(Unit, FactorsOfAProductAndAQuotientMultiply) {
    EXPECT_DOUBLE_EQ(parse_unit("N/mm*ms")->factor, 1.0) << "1000 N/m of 1 ms";
    EXPECT_DOUBLE_EQ(parse_unit("mN mm")->factor, 1e-6);
    EXPECT_DOUBLE_EQ(parse_unit("kN/mm2")->factor, 1e9);
    EXPECT_DOUBLE_EQ(parse_unit("1/ms^2")->factor, 1e6);
    EXPECT_DOUBLE_EQ(parse_unit("min/mm/s")->factor, 60e3);
    EXPECT_DOUBLE_EQ(parse_unit("mm^4")->factor, 1e-12);
    EXPECT_DOUBLE_EQ(parse_unit("%/s")->factor, 0.01);
}

TEST(Unit, HasTheFactorAndTheDimensionOfItsName) {
    const struct {
        const char* name;
        double factor;
        kerf_dimension dimension;
    } units[] = {{"1", 1.0, dimension::none},
                 {"%", 0.01, dimension::none},
                 {"m", 1.0, dimension::length},
                 {"cm", 0.01, dimension::length},
                 {"mm", 1e-3, dimension::length},
                 {"um", 1e-6, dimension::length},
                 {"µm", 1e-6, dimension::length},
                 {"rad", 1.0, dimension::angle},
                 {"deg", pi / 180, dimension::angle},
                 {"s", 1.0, dimension::time},
                 {"ms", 1e-3, dimension::time},
                 {"us", 1e-6, dimension::time},
                 {"µs", 1e-6, dimension::time},
                 {"min", 60.0, dimension::time},
                 {"Hz", 1.0, dimension::frequency},
                 {"kHz", 1e3, dimension::frequency},
                 {"rpm", 1.0 / 60, dimension::frequency},
                 {"kg", 1.0, dimension::mass},
                 {"g", 1e-3, dimension::mass},
                 {"mg", 1e-6, dimension::mass},
                 {"N", 1.0, dimension::force},
                 {"mN", 1e-3, dimension::force},
                 {"kN", 1e3, dimension::force},
                 {"Nm", 1.0, dimension::torque},
                 {"Nmm", 1e-3, dimension::torque},
                 {"J", 1.0, dimension::torque},
                 {"mJ", 1e-3, dimension::torque},
                 {"Pa", 1.0, dimension::pressure},
                 {"kPa", 1e3, dimension::pressure},
                 {"MPa", 1e6, dimension::pressure},
                 {"GPa", 1e9, dimension::pressure},
                 {"ml", 1e-6, dimension::volume}};
    for (const auto& [name, factor, dimension] : units) {
        const auto unit = parse_unit(name);
        ASSERT_TRUE(unit) << name;
        EXPECT_DOUBLE_EQ(unit->factor, factor) << name;
        EXPECT_TRUE(unit->dimension == dimension) << name;
    }
}

TEST(Unit, HasPowersFromTwoToFourAndNoOthers) {
    for (const char* text : {"mm2", "mm^2", "mm²"}) EXPECT_DOUBLE_EQ(parse_unit(text)->factor, 1e-6) << text;
    for (const char* text : {"mm3", "mm^3", "mm³"}) EXPECT_DOUBLE_EQ(parse_unit(text)->factor, 1e-9) << text;
    for (const char* text : {"mm1", "mm5", "mm^1", "mm^", "2", "mm22", "", " ", "mm*", "*mm"})
        EXPECT_FALSE(parse_unit(text)) << text;
}

TEST(Unit, HasAtMostSixFactors) {
    EXPECT_TRUE(parse_unit("m m m m m m"));
    EXPECT_FALSE(parse_unit("m m m m m m m"));
}

TEST(Quantity, AllowsEachEndOfItsRangeAndNoMore) {
    const QuantityNeed between{dimension::none, "", -2.0, 5.0};
    for (const char* text : {"-2", "5", "-1.9", "4.9"}) EXPECT_TRUE(parse_quantity(text, "it", between).value) << text;
    for (const char* text : {"-2.000001", "5.000001", "-3", "6"})
        EXPECT_EQ(problem(text, between).code, Code::out_of_range) << text;
    const Parsed<Vec3> inside = parse_vector("-2 5 0", "it", between);
    EXPECT_TRUE(inside.value);
    for (const char* text : {"-2.1 0 0", "0 5.1 0", "0 0 6"})
        EXPECT_EQ(parse_vector(text, "it", between).problem.code, Code::out_of_range) << text;
}

TEST(Quantity, SuggestsTheLikelySlipWhenOutOfRange) {
    const QuantityNeed between{dimension::none, "", 10.0, 40.0};
    EXPECT_EQ(problem("-20", between).write, "20") << "the sign";
    EXPECT_EQ(problem("200", between).write, "20") << "ten times too much";
    EXPECT_EQ(problem("400", between).write, "40");
    EXPECT_EQ(problem("80", between).write, "") << "twice too much is no slip of the point";
    EXPECT_EQ(problem("81", between).write, "") << "a tenth of it would be too little";
    EXPECT_EQ(problem("500", between).write, "");
    EXPECT_EQ(problem("2", between).write, "20") << "ten times too little";
    EXPECT_EQ(problem("1", between).write, "10");
    EXPECT_EQ(problem("5", between).write, "") << "half is no slip of the point";
    EXPECT_EQ(problem("0.5", between).write, "");
    EXPECT_EQ(problem("0", between).write, "");
}

TEST(Quantity, APlainNumberMayHaveAFractionAndPercent) {
    EXPECT_EQ(value("-3/4", any_number), -0.75);
    EXPECT_EQ(value("50 %", any_number), 0.5);
    EXPECT_EQ(value("1/2 %", any_number), 0.005);
    EXPECT_EQ(value(" 7 ", any_number), 7.0);
    for (const char* text : {"1/", "1/x", "/2", "1//2"}) EXPECT_FALSE(parse_quantity(text, "it", any_number).value);
    EXPECT_EQ(problem("1/2 mm", any_length).code, Code::not_a_number) << "no fraction of a length";
}

TEST(Quantity, CutsALongTextThatItQuotes) {
    const std::string forty(40, 'x'), more(41, 'x');
    EXPECT_NE(problem(forty, any_length).message.find("got `" + forty + "`, "), std::string::npos);
    EXPECT_EQ(problem(more, any_length).message.find("got `" + more + "`, "), std::string::npos);
}

TEST(QuantityPattern, TakesWhatIsReadAndRefusesWhatIsNot) {
    const std::regex length(quantity_pattern(any_length)), number(quantity_pattern(any_number)),
        vector(vector_pattern(any_length)), direction(vector_pattern(any_number)),
        volume(quantity_pattern(need(dimension::volume, "ml")));
    for (const char* text : {"3.2 mm", "-3 mm", ".5 m", "3. cm", "1e-3 um", " 3 mm ", "3 mm^2/mm"})
        EXPECT_TRUE(std::regex_match(text, length)) << text;
    for (const char* text : {"3.2", "mm", "3 s", "3,2 mm", "3 mm2", "1/2 mm", "--3 mm"})
        EXPECT_FALSE(std::regex_match(text, length)) << text;
    for (const char* text : {"3.2", "1/50", "50 %", "-1 / 3"}) EXPECT_TRUE(std::regex_match(text, number)) << text;
    for (const char* text : {"3 mm", "x", "1/", "3 %2"}) EXPECT_FALSE(std::regex_match(text, number)) << text;
    for (const char* text : {"1 2 3 mm", "-1 .5 3e2 cm"}) EXPECT_TRUE(std::regex_match(text, vector)) << text;
    for (const char* text : {"1 2 mm", "1 2 3", "1 2 3 4 mm", "1 2 3 s"})
        EXPECT_FALSE(std::regex_match(text, vector)) << text;
    EXPECT_TRUE(std::regex_match("0 0 1", direction));
    EXPECT_FALSE(std::regex_match("0 0 1 mm", direction));
    for (const char* text : {"3 ml", "3 mm3", "3 mm^3", "3 mm³", "3 m cm2"})
        EXPECT_TRUE(std::regex_match(text, volume)) << text;
    for (const char* text : {"3 mm", "3 mm2", "3 ml2"}) EXPECT_FALSE(std::regex_match(text, volume)) << text;
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

TEST(Quantity, NamesTheKindInPlaceOfAConversion) {
    const QuantityProblem mass = problem("60 kg", need(dimension::force, "N"));
    EXPECT_EQ(mass.code, Code::wrong_dimension);
    EXPECT_EQ(mass.message, "it is a mass: got `60 kg`, expected a force in N. Write the value in N.");
    EXPECT_EQ(mass.write, "");
    EXPECT_EQ(problem("4 N", any_length).write, "");
    EXPECT_EQ(problem("4 psi", any_length).code, Code::wrong_dimension);
}

TEST(Quantity, ReadsAClockAsSecondsToWrite) {
    const QuantityNeed need{dimension::time, "s", 1.0, 3600.0};
    for (const auto& [text, write] : {std::pair{"2:30", "150 s"}, {"0:02:30", "150 s"}, {"2:30 min", ""}, {"2:3", ""}})
        EXPECT_EQ(parse_quantity(text, "time_limit", need).problem.write, write) << text;
    EXPECT_EQ(parse_quantity("2:30", "depth", {dimension::length, "mm", 0.0, 1.0}).problem.write, "");
}

TEST(Quantity, NamesBothKindsOfAUnitOfEnergy) {
    const auto power = parse_quantity("30 J", "drive_power", {parse_unit("W")->dimension, "W", 0.0, 100.0});
    EXPECT_NE(power.problem.message.find("drive_power is an energy or a torque: "), std::string::npos)
        << power.problem.message;
}

TEST(Quantity, ConvertsForeignUnitsExactly) {
    const QuantityNeed force = need(dimension::force, "N"), pressure = need(dimension::pressure, "MPa"),
                       torque = need(dimension::torque, "Nmm"), speed = need(dimension::speed, "mm/s"),
                       turns = need(dimension::frequency, "rpm"), angle = need(dimension::angle, "deg");
    for (const auto& [text, wanted, write] : {std::tuple{"0.4 in", any_length, "10.16 mm"},
                                              {"0.4in", any_length, "10.16 mm"},
                                              {"0.4\"", any_length, "10.16 mm"},
                                              {"3/8 inch", any_length, "9.525 mm"},
                                              {"10 thou", any_length, "0.254 mm"},
                                              {"1 ft", any_length, "304.8 mm"},
                                              {"500 microns", any_length, "0.5 mm"},
                                              {"1 kgf", force, "9.80665 N"},
                                              {"10 lbf", force, "44.48221615 N"},
                                              {"1000 psi", pressure, "6.894757293 MPa"},
                                              {"1 in-lb", torque, "112.984829 Nmm"},
                                              {"1 in/s", speed, "25.4 mm/s"},
                                              {"1000 RPM", turns, "1000 rpm"},
                                              {"1000 rev/min", turns, "1000 rpm"},
                                              {"1000 min-1", turns, "1000 rpm"},
                                              {"118\u00B0", angle, "118 deg"}}) {
        const QuantityProblem refused = problem(text, wanted);
        EXPECT_EQ(refused.code, Code::unknown_unit) << text;
        EXPECT_EQ(refused.write, write) << text;
        EXPECT_NE(refused.message.find("a unit that Kerf does not read"), std::string::npos) << refused.message;
    }
    const QuantityNeed diameter{dimension::length, "mm", 0.5_mm, 20.0_mm};
    EXPECT_EQ(problem("1 in", diameter).write, "") << "25.4 mm is out of range";
}

TEST(Quantity, OffersNoValueForAnUnknownUnit) {
    for (const char* text : {"3 furlong", "3 MM", "3.2.1 mm", "5-10 mm", "5 - 10 mm", "5 \u00B1 1 mm", "1 2 mm"})
        EXPECT_EQ(problem(text, any_length).write, "") << text << " " << problem(text, any_length).message;
}

TEST(Quantity, ReadsBothMusAsMicro) {
    EXPECT_EQ(value("1000 \u03BCm", any_length), value("1000 um", any_length));
    EXPECT_EQ(value("1000 \u00B5m", any_length), value("1000 um", any_length));
    EXPECT_EQ(value("300 \u03BCs", need(dimension::time, "us")), 300e-6);
}

TEST(Quantity, JoinsThousandsThatAreSetApart) {
    const QuantityNeed turns = need(dimension::frequency, "rpm");
    for (const auto& [text, write] : {std::pair{"1 000 rpm", "1000 rpm"},
                                      {"12 345.5 rpm", "12345.5 rpm"},
                                      {"12'345 rpm", "12345 rpm"},
                                      {"1_000 rpm", "1000 rpm"},
                                      {"1,000,000 rpm", "1000000 rpm"},
                                      {"1.234,5 rpm", "1234.5 rpm"},
                                      {"1\u202F000 rpm", "1000 rpm"},
                                      {"1 000", "1000 rpm"}}) {
        EXPECT_EQ(problem(text, turns).code, Code::not_a_number) << text;
        EXPECT_EQ(problem(text, turns).write, write) << text;
    }
}

TEST(Quantity, NamesLookAlikesByTheirCodePoint) {
    for (const auto& [text, code] : {std::pair{"\u22125 mm", "U+2212 (minus sign), not `-`"},
                                     {"\u20135 mm", "U+2013 (en dash), not `-`"},
                                     {"5\u00A0mm", "U+00A0 (no-break space), not a plain space"},
                                     {"\uFF15 mm", "U+FF15 (full-width character), not `5`"},
                                     {"\u201C5 mm\u201D", "U+201C (quotation mark)"},
                                     {"5 \u043Cm", "U+043C (Cyrillic letter), not `m`"},
                                     {"5\u200B mm", "U+200B (zero width space)"}})
        EXPECT_NE(problem(text, any_length).message.find(code), std::string::npos) << problem(text, any_length).message;
    EXPECT_EQ(problem("\u22125 mm", any_length).write, "-5 mm");
    EXPECT_EQ(problem("\uFF15\u00A0mm", any_length).write, "5 mm");
    EXPECT_EQ(problem_of_vector("1 \u22122 3 mm").write, "1 -2 3 mm");
}

TEST(Quantity, OffersASlipOfThePointOnlyWhereItFits) {
    const QuantityNeed diameter{dimension::length, "mm", 0.5_mm, 20.0_mm};
    EXPECT_EQ(problem("32 mm", diameter).write, "3.2 mm");
    EXPECT_EQ(problem("3200 mm", diameter).write, "3.2 mm");
    EXPECT_EQ(problem("0.032 mm", diameter).write, "3.2 mm") << "by the smallest shift that fits";
    EXPECT_EQ(problem("3.2 m", diameter).write, "3.2 mm") << "a slip of the unit";
    EXPECT_EQ(problem("21 mm", diameter).write, "");
    EXPECT_EQ(problem("0 mm", diameter).write, "");
    EXPECT_EQ(problem("21 mm", diameter).message,
              "it is out of range: got 21 mm, expected 0.5 mm … 20 mm. Write a value in this range.");
}

TEST(Quantity, OffersNoUnitThatGivesNoPlausibleValue) {
    const QuantityNeed diameter{dimension::length, "mm", 0.5_mm, 20.0_mm}, share{dimension::none, "%", 0.001, 0.5};
    EXPECT_EQ(problem("0.0032", diameter).write, "") << "metres are meant";
    EXPECT_EQ(problem("0.2", share).write, "") << "a fifth or 0.2 %";
    EXPECT_EQ(problem("7", share).write, "7 %");
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
    EXPECT_EQ(refused.message, "it has a decimal comma: got `1,000 mm`, expected a decimal point. Write `1000 mm` for "
                               "thousands, or `1.000 mm`.");
    EXPECT_EQ(refused.write, "");
    EXPECT_EQ(problem("0,250 mm", any_length).write, "0.250 mm") << "no one writes thousands so";
}

TEST(Quantity, ACommaMayMeanThousandsBehindUpToThreeDigits) {
    for (const auto& [text, whole] :
         {std::pair{"12,000 mm", "12000 mm"}, {"125,000 mm", "125000 mm"}, {"-125,000 mm", "-125000 mm"}}) {
        const QuantityProblem refused = problem(text, any_length);
        EXPECT_EQ(refused.write, "") << text;
        EXPECT_NE(refused.message.find("Write `" + std::string(whole) + "` for thousands"), std::string::npos)
            << refused.message;
    }
    EXPECT_EQ(problem("1250,000 mm", any_length).write, "1250.000 mm") << "a group has three digits at most";
    EXPECT_EQ(problem("125,00 mm", any_length).write, "125.00 mm") << "and exactly three follow";
    EXPECT_EQ(problem("125,0000 mm", any_length).write, "125.0000 mm");
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
    EXPECT_EQ(parsed.problem.message,
              "drill.diameter is out of range: got 65 mm, expected 0.5 mm … 20 mm. Did the decimal point "
              "slip?");
    EXPECT_EQ(parsed.problem.write, "6.5 mm");
}

TEST(Quantity, OutOfRangeIsAnsweredInTheUnitItWasWrittenInWithAValueThatWouldBeRead) {
    const QuantityNeed diameter{dimension::length, "mm", 0.5_mm, 20.0_mm};
    EXPECT_EQ(problem("-3.2 mm", diameter).write, "3.2 mm");
    EXPECT_EQ(problem("-3200 um", diameter).message,
              "it is out of range: got -3200 um, expected 500 um … 20000 um. Did the sign slip?");
    EXPECT_EQ(problem("-3200 um", diameter).write, "3200 um");

    const QuantityNeed angle{dimension::angle, "deg", 60.0_deg, 160.0_deg};
    EXPECT_EQ(problem("0.4 rad", angle).message,
              "it is out of range: got 0.4 rad, expected 60 deg … 160 deg. Write a value in this range.")
        << "no one reads 1.047197551 rad";
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
        EXPECT_TRUE(write.empty() || parse_quantity(write, "it", need).value) << text << " → " << write;
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
              "at is not three numbers: got `left of the canal`, expected three numbers and one unit, as in `1 2 3 "
              "mm`. Write x, y and z.");
}

TEST(QuantityText, IsShort) {
    EXPECT_EQ(quantity_text(20.0_mm, "mm"), "20 mm");
    EXPECT_EQ(quantity_text(118.0_deg, "deg"), "118 deg");
    EXPECT_EQ(quantity_text(0.25, ""), "0.25");
}

}  // namespace
}  // namespace kerf::text
