// SPDX-License-Identifier: Apache-2.0
#include "core/plugin/si_unit.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "core/plugin/unit.h"
#include "kerf/units.hpp"

namespace kerf {
namespace {

TEST(SiUnit, NamesTheUnitOfWhatIsShown) {
    for (const auto& [shown, si] : {std::pair<const char*, const char*>{"mm", "m"},
                                    {"um", "m"},
                                    {"mm3", "m^3"},
                                    {"ml", "m^3"},
                                    {"deg", "rad"},
                                    {"deg/s", "rad/s"},
                                    {"rpm", "1/s"},
                                    {"Nmm", "N*m"},
                                    {"mJ", "N*m"},
                                    {"kN", "N"},
                                    {"N/mm", "N/m"},
                                    {"N/mm^2", "Pa"},
                                    {"Nmm/deg", "N*m/rad"},
                                    {"mm/s", "m/s"},
                                    {"g/cm3", "kg/m^3"},
                                    {"mW", "W"},
                                    {"%", ""},
                                    {"1", ""},
                                    {"", ""}})
        EXPECT_EQ(si_unit_of(shown), si) << shown;
}

TEST(SiUnit, LeavesAnUnknownUnitAsItIs) { EXPECT_EQ(si_unit_of("grade"), "grade"); }

TEST(SiUnit, IsReadBackAsTheSameDimension) {
    const auto expect_same = [](const kerf_dimension& dimension) {
        const std::string name = si_unit(dimension);
        if (name.empty()) {
            EXPECT_TRUE(dimension == dimension::none);
            return;
        }
        const auto unit = parse_unit(name);
        ASSERT_TRUE(unit) << name;
        EXPECT_EQ(unit->factor, 1.0) << name;
        EXPECT_TRUE(unit->dimension == dimension) << name;
    };
    for (const UnitSymbol& symbol : unit_symbols()) expect_same(symbol.dimension);
    using namespace dimension;
    for (const kerf_dimension& dimension : {speed, force_per_length, pressure, density, volume, power, inertia, energy,
                                            damping, angular_stiffness, kerf_dimension{{-1, 0, -2, 0, 0, 0, 0, 1}}})
        expect_same(dimension);
}

}  // namespace
}  // namespace kerf
