// SPDX-License-Identifier: Apache-2.0
#include "run/verdict/screw_grade.h"

#include "kerf/units.hpp"

namespace kerf::run {

namespace {

using namespace literals;

std::string grade_of(double breach) {
    if (breach <= 0.0) return "A";
    if (breach < 2.0_mm) return "B";
    if (breach < 4.0_mm) return "C";
    return breach < 6.0_mm ? "D" : "E";
}

}  // namespace

std::string gertzbein_robbins(double least, double most) {
    const std::string best = grade_of(least), worst = grade_of(most);
    return best == worst ? best : best + "/" + worst;
}

std::string heary(const BreachLocations& places) {
    if (places.in_zone) return "V";
    if (places.medial_of_pedicle) return "IV";
    if (places.of_body) return "III";
    return places.lateral_of_pedicle ? "II" : "I";
}

std::string heary(const BreachLocations& least, const BreachLocations& most) {
    const std::string best = heary(least), worst = heary(most);
    return best == worst ? best : best + "/" + worst;
}

}  // namespace kerf::run
