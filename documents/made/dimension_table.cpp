// SPDX-License-Identifier: Apache-2.0
#include "documents/made/dimension_table.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kerf/units.hpp"
#include "text/quantity.h"

namespace kerf::documents {

using namespace literals;

Dimension& DimensionTable::add(Dimension dimension, double floor, double digit) {
    Dimension& d = all.emplace_back(std::move(dimension));
    const double parent = before_truncation * d.sd, may_set = 4.0 * parent;
    d.min_drawn = std::max(floor, d.mean - truncation * parent);
    d.max_drawn = d.mean + truncation * parent;
    d.min_set = std::max(floor, std::ceil((d.mean - may_set) / digit) * digit);
    d.max_set = std::floor((d.mean + may_set) / digit) * digit;
    return d;
}

Dimension& DimensionTable::length(const char* name, const char* help, double mean_mm, double sd_mm, double loading,
                                  Evidence evidence, const char* source, double floor_mm) {
    return add({.name = name,
                .help = help,
                .dimension = dimension::length,
                .unit = "mm",
                .mean = mean_mm * 1e-3,
                .sd = sd_mm * 1e-3,
                .loading = loading,
                .is_along_spine = true,
                .evidence = evidence,
                .source = source},
               floor_mm * 1e-3, 0.01_mm);
}

Dimension& DimensionTable::angle(const char* name, const char* help, double mean_deg, double sd_deg, Evidence evidence,
                                 const char* source) {
    return add({.name = name,
                .help = help,
                .dimension = dimension::angle,
                .unit = "deg",
                .mean = mean_deg * 1.0_deg,
                .sd = sd_deg * 1.0_deg,
                .evidence = evidence,
                .source = source},
               -HUGE_VAL, 0.01_deg);
}

Dimension& DimensionTable::density(const char* name, const char* help, double mean, double sd, Evidence evidence,
                                   const char* source, double floor) {
    return add({.name = name,
                .help = help,
                .dimension = dimension::density,
                .unit = "g/cm3",
                .mean = mean,
                .sd = sd,
                .evidence = evidence,
                .source = source},
               floor, 1.0);
}

std::string dimension_text(double value, const char* unit) {
    return text::quantity_text(std::round(value * 1e5) * 1e-5, unit);
}

}  // namespace kerf::documents
