// SPDX-License-Identifier: Apache-2.0
#include "conformance/parameter_sets.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "conformance/words.h"
#include "core/plugin/unit.h"

namespace kerf::conformance {

namespace {

template <class Row>
std::string name_of(const Row& row, double value) {
    const auto unit = parse_unit(row.display_unit);
    const std::string in_unit = number(unit ? value / unit->factor : value);
    return "`" + std::string(row.id) + "` " + in_unit + (*row.display_unit != '\0' ? " " : "") + row.display_unit;
}

template <class Row>
std::vector<double> defaults_of(const Row* rows, std::uint32_t count) {
    std::vector<double> values;
    for (std::uint32_t i = 0; i < count; ++i) values.push_back(rows[i].def);
    return values;
}

/// The i-th number of the sequence of van der Corput in `base`, in 0 … 1: evenly spread, the same everywhere.
double spread(std::uint32_t i, std::uint32_t base) {
    double value = 0.0, step = 1.0;
    for (; i > 0; i /= base) {
        step /= base;
        value += step * (i % base);
    }
    return value;
}

constexpr std::uint32_t primes[] = {2,  3,  5,  7,  11, 13, 17, 19, 23, 29,  31,  37,  41,  43,  47,  53,
                                    59, 61, 67, 71, 73, 79, 83, 89, 97, 101, 103, 107, 109, 113, 127, 131};

template <class Row>
void add_ends(const Row* rows, std::uint32_t count, std::vector<ParameterSet>& sets) {
    const std::vector<double> defaults = defaults_of(rows, count);
    for (std::uint32_t i = 0; i < count; ++i)
        for (const double end : {rows[i].min, rows[i].max}) {
            if (end == rows[i].def) continue;
            ParameterSet set{name_of(rows[i], end), defaults};
            set.values[i] = end;
            sets.push_back(std::move(set));
        }
}

}  // namespace

std::string named(const kerf_param& row, double value) { return name_of(row, value); }

bool is_count(const kerf_param& row) {
    return *row.display_unit == '\0' && std::trunc(row.min) == row.min && std::trunc(row.max) == row.max &&
           std::trunc(row.def) == row.def;
}

std::vector<double> default_parameters(const kerf_component& component) {
    return defaults_of(component.params, component.param_count);
}

std::vector<ParameterSet> parameter_sets(const kerf_component& component, int random) {
    const std::uint32_t count = component.param_count;
    const kerf_param* const rows = component.params;
    std::vector<ParameterSet> sets{{"the defaults", defaults_of(rows, count)}};
    if (count == 0) return sets;
    add_ends(rows, count, sets);
    ParameterSet least{"all parameters at their least", {}}, most{"all parameters at their most", {}};
    for (std::uint32_t i = 0; i < count; ++i) {
        least.values.push_back(rows[i].min);
        most.values.push_back(rows[i].max);
    }
    sets.push_back(std::move(least));
    sets.push_back(std::move(most));
    for (int n = 1; n <= random; ++n) {
        ParameterSet set{"these parameters: ", {}};
        for (std::uint32_t i = 0; i < count; ++i) {
            const double share = spread(static_cast<std::uint32_t>(n + 7 * static_cast<int>(i / std::size(primes))),
                                        primes[i % std::size(primes)]);
            set.values.push_back(
                std::clamp(rows[i].min + share * (rows[i].max - rows[i].min), rows[i].min, rows[i].max));
            if (i < 6) set.name += (i > 0 ? ", " : "") + name_of(rows[i], set.values.back());
        }
        if (count > 6) set.name += " …";
        sets.push_back(std::move(set));
    }
    return sets;
}

std::vector<double> drives_at_rest(const kerf_component& tool) {
    std::vector<double> values;
    for (std::uint32_t i = 0; i < tool.tool->drive_count; ++i)
        values.push_back(std::clamp(0.0, tool.tool->drives[i].min, tool.tool->drives[i].max));
    return values;
}

std::vector<ParameterSet> drive_sets(const kerf_component& tool) {
    const kerf_drive* const rows = tool.tool->drives;
    const std::uint32_t count = tool.tool->drive_count;
    std::vector<ParameterSet> sets{{"the default drives", defaults_of(rows, count)}};
    if (count == 0) return sets;
    sets.push_back({"all drives at rest", drives_at_rest(tool)});
    add_ends(rows, count, sets);
    return sets;
}

}  // namespace kerf::conformance
