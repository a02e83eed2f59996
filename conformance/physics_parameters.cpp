// SPDX-License-Identifier: Apache-2.0
// Level 4: a law over its parameters, drives, feeds and ticks: for size, and not only for soundness.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "conformance/parameter_sets.h"
#include "conformance/sweep.h"
#include "conformance/test_groups.h"

namespace kerf::conformance {

namespace {

// ---- parameters ---------------------------------------------------------------------------------------------------

/// Values of a parameter from its least to its most, at even ratios where the range is wide.
std::vector<double> values_over(const kerf_param& row) {
    constexpr int count = 4;
    std::vector<double> values;
    const bool by_ratio = row.min > 0.0 && row.max > 20.0 * row.min;
    for (int i = 0; i <= count; ++i) {
        const double part = static_cast<double>(i) / count;
        values.push_back(by_ratio ? row.min * std::pow(row.max / row.min, part) : row.min + part * (row.max - row.min));
    }
    values.back() = row.max;
    return values;
}

Sweep over_range(const Subject& subject, bool is_of_tool, std::uint32_t index) {
    const kerf_component& component = is_of_tool ? *subject.tool : *subject.force;
    const kerf_param& row = component.params[index];
    return {.subject = subject,
            .settings =
                [&component, is_of_tool, index](double value) {
                    WalkSettings settings = solid_bone();
                    std::vector<double> values = default_parameters(component);
                    values[index] = value;
                    (is_of_tool ? settings.tool_parameters : settings.force_parameters) = std::move(values);
                    return settings;
                },
            .named = [&row](double value) { return named(row, value); }};
}

void varies_smoothly(Examination& exam) {
    for (const bool is_of_tool : {true, false}) {
        const kerf_component& component = is_of_tool ? *exam.subject->tool : *exam.subject->force;
        for (std::uint32_t p = 0; p < component.param_count; ++p) {
            if (is_count(component.params[p])) continue;
            const Sweep sweep = over_range(*exam.subject, is_of_tool, p);
            if (const std::string text = jump_along(sweep, values_over(component.params[p])); !text.empty())
                return exam.fail(text);
        }
    }
}

/// By how much a size follows a parameter: the exponent of a power law.
double exponent(double low, double high, double of_low, double of_high) {
    if (low <= 0.0 || of_low <= 0.0 || of_high <= 0.0) return 0.0;
    return std::abs(std::log(of_high / of_low) / std::log(high / low));
}

void uses_whole_ranges(Examination& exam) {
    constexpr double clear = 0.5;  // exponent of a parameter that matters
    for (const bool is_of_tool : {true, false}) {
        const kerf_component& component = is_of_tool ? *exam.subject->tool : *exam.subject->force;
        for (std::uint32_t p = 0; p < component.param_count; ++p) {
            const Sweep sweep = over_range(*exam.subject, is_of_tool, p);
            const double lowest = component.params[p].min, width = component.params[p].max - lowest;
            const double value[] = {lowest, lowest + 0.1 * width, lowest + 0.25 * width, lowest + 0.9 * width,
                                    lowest + width};
            std::array<Sizes, 5> sizes{};
            bool is_made = true;
            for (std::size_t i = 0; i < 5 && is_made; ++i) is_made = sizes_at(sweep, value[i], sizes[i]);
            if (!is_made) continue;
            const auto of = [&](std::size_t i, std::size_t which) { return sizes[i][which]; };
            const auto is_stuck = [&](std::size_t a, std::size_t b) {
                for (std::size_t which = 0; which < 3; ++which)
                    if (std::abs(of(a, which) - of(b, which)) > 1e-9 * std::abs(of(a, which))) return false;
                return true;
            };
            for (std::size_t which = 0; which < 3; ++which)
                if (is_stuck(3, 4) && of(3, which) > 0.0 &&
                    exponent(value[1], value[2], of(1, which), of(2, which)) > clear)
                    return exam.fail(
                        "With " + sweep.named(value[1]) + " it makes " + number(of(1, which)) + " N, and with " +
                        sweep.named(value[2]) + " " + number(of(2, which)) + " N, " + name_of_size[which] + "; with " +
                        sweep.named(value[3]) + " and with " + sweep.named(value[4]) +
                        " it makes the same to the last bit. Let a range end where the parameter ceases to act.");
        }
    }
}

// ---- drives -------------------------------------------------------------------------------------------------------

void knows_its_drives(Examination& exam) {
    const kerf_tool& tool = *exam.subject->tool->tool;
    double lowest = 0.0;  // [–] of the default, from where on it cuts
    for (std::uint32_t i = 0; i < tool.drive_count; ++i)
        if (tool.drives[i].def != 0.0) lowest = std::max(lowest, tool.drives[i].least / std::abs(tool.drives[i].def));
    if (tool.drive_count == 0) return exam.skip("the tool has no drive");
    const double slow = std::max(0.5, 1.1 * lowest);
    if (slow > 0.9) return exam.skip("the tool cuts near its default drive alone");
    const auto response = [&](double fraction) {
        WalkSettings settings = solid_bone();
        settings.drives = drives_at(*exam.subject->tool, fraction);
        LawProbe probe(*exam.subject, settings);
        return std::pair{probe.move(at_depth(0), probe.feed(probe_speed)), probe.feed(probe_speed)};
    };
    const auto [full, rate] = response(1.0);
    const Response half = response(slow).first;
    const double of_full = against(full, rate), of_half = against(half, rate);
    if (of_full < 1e-9) return exam.skip("it resists nothing in solid bone");
    const std::string text = "Fed in solid bone at 0.5 mm/s, it is resisted with " + number(of_half) + " N at " +
                             number(100.0 * slow) + " % of its default drive and with " + number(of_full) +
                             " N at all of it";
    if (of_half < 0.98 * of_full)
        exam.fail(text + ", expected no less when it is driven less: each chip is thicker then.");
    else if (of_half < 1.005 * of_full)
        exam.fail(text + ", expected more when it is driven less: each chip is thicker then.");
    else if (full.cut_ticks == full.ticks && half.cut_ticks < half.ticks)
        exam.fail("At " + number(100.0 * slow) +
                  " % of its default drive, which is above its `least`, it requests `cut` in " +
                  std::to_string(half.cut_ticks) + " of " + std::to_string(half.ticks) +
                  " ticks in solid bone, expected in each.");
}

void resists_all_feeds(Examination& exam) {
    constexpr double rates[] = {0.1e-3, 0.3e-3, 1e-3, 2e-3, 4e-3, 7e-3, 10e-3, 15e-3, 20e-3, 40e-3};  // [m/s]
    LawProbe probe(*exam.subject, solid_bone());
    if (!probe.refusal().empty()) return exam.skip(probe.refusal());
    for (const auto& [name, motion] : probe.motions(1.0)) {
        double before = 0.0, rate_before = 0.0;
        for (const double r : rates) {
            Vec6 rate = motion;
            for (double& part : rate) part *= r;
            const Response response = probe.move(at_depth(0), rate);
            if (exam.subject->tool->tool->drive_count > 0 && response.cut_ticks < response.ticks) break;  // it stalls
            const double force = against(response, rate);
            if (force < 0.97 * before)
                return exam.fail("Running and " + name + " in solid bone at " + number(1e3 * r) +
                                 " mm/s, it is resisted with " + number(force) + " N, and with " + number(before) +
                                 " N at " + number(1e3 * rate_before) + " mm/s, expected no less at the faster feed.");
            before = force;
            rate_before = r;
        }
    }
}

// ---- time ---------------------------------------------------------------------------------------------------------

/// What a law shows over time, each 10 ms.
struct Shown {
    std::vector<std::vector<double>> values;  ///< signals, then the wrench
    double first_cut = -1.0;                  ///< [s]
};

/// Switched on in air, led into bone 0.3 s later, 1 mm deep.
Shown shown_with(const Subject& subject, double dt, double drive) {
    constexpr double still = 0.2, lasts = 0.6, rate = 2e-3;  // [s], [s], [m/s]
    WalkSettings settings;
    settings.dt = dt;
    settings.drives = drives_at(*subject.tool, drive);
    LawWalk law(subject, settings);
    Shown shown;
    if (!law.refusal().empty()) return shown;
    const auto pose_at = [&](double t) { return at_depth(-0.1e-3 + rate * std::max(0.0, t - still)); };
    law.begin(pose_at(0.0));
    const int count = static_cast<int>(std::lround(lasts / dt)), each = static_cast<int>(std::lround(10e-3 / dt));
    for (int i = 0; i < count; ++i) {
        if (law.resist() != KERF_OK) return shown;
        const Pose next = pose_at((i + 1) * dt);
        const Vec6 wrench = law.force_at(law.rate_to(next));
        if (law.commit(next) != KERF_OK) return shown;
        if (shown.first_cut < 0.0 && law.committed().action_count > 0 &&
            law.committed().action[0].kind == KERF_ACTION_CUT)
            shown.first_cut = (i + 1) * dt;
        if ((i + 1) % each != 0) continue;
        std::vector<double> now(law.signals().begin(), law.signals().end());
        now.insert(now.end(), wrench.begin(), wrench.end());
        shown.values.push_back(std::move(now));
    }
    return shown;
}

void runs_by_the_clock(Examination& exam, double drive) {
    const kerf_force& force = *exam.subject->force->force;
    const Shown at_1_ms = shown_with(*exam.subject, 1e-3, drive);
    for (const double dt : {2e-3, 0.5e-3}) {
        const Shown other = shown_with(*exam.subject, dt, drive);
        const std::string ticks = "In ticks of " + number(1e3 * dt) + " ms ";
        if (std::abs(other.first_cut - at_1_ms.first_cut) > 6e-3)
            return exam.fail(ticks + "it cuts first " + number(other.first_cut) +
                             " s after its drive was switched on, and " + number(at_1_ms.first_cut) +
                             " s in ticks of 1 ms, expected the same. Multiply by `dt` what counts per tick.");
        for (std::size_t k = 0; at_1_ms.values.size() == other.values.size() && k < force.signal_count + 6; ++k) {
            double largest = 0.0;
            for (const auto& now : at_1_ms.values) largest = std::max(largest, std::abs(now[k]));
            for (std::size_t i = 1; i + 1 < other.values.size(); ++i) {
                const double before = at_1_ms.values[i - 1][k], here = at_1_ms.values[i][k],
                             after = at_1_ms.values[i + 1][k];
                const double low = std::min({before, here, after}), high = std::max({before, here, after});
                const double off = std::max({0.0, low - other.values[i][k], other.values[i][k] - high});
                if (off > 0.1 * largest + 1e-6)
                    return exam.fail(
                        ticks +
                        (k < force.signal_count ? "its signal `" + std::string(force.signals[k].id) + "`"
                                                : "its wrench[" + std::to_string(k - force.signal_count) + "]") +
                        " is " + number(other.values[i][k]) + " " + number(10e-3 * static_cast<double>(i + 1)) +
                        " s after its drive was switched on, and " + number(here) +
                        " in ticks of 1 ms (SI units), expected the same within 10 %. Multiply by `dt` what counts per "
                        "tick.");
            }
        }
    }
}

void runs_and_rests_by_the_clock(Examination& exam) {
    runs_by_the_clock(exam, 1.0);
    if (exam.status() == Status::passed && exam.subject->tool->tool->drive_count > 0) runs_by_the_clock(exam, 0.0);
}

constexpr int long_time = 40;  // [s] of processor time
constexpr Test tests[] = {
    {"physics.parameters", 4, Scope::law, "Its force does not jump with a parameter.", &varies_smoothly, "law.sound",
     long_time},
    {"physics.ranges", 4, Scope::law, "A parameter acts over its whole range.", &uses_whole_ranges, "law.sound",
     long_time},
    {"physics.drives", 4, Scope::law, "Driven less, it is resisted more.", &knows_its_drives, "law.sound", long_time},
    {"physics.feeds", 4, Scope::law, "From slow to fast feed, in each direction, it is resisted no less.",
     &resists_all_feeds, "law.sound", long_time},
    {"physics.clock", 4, Scope::law, "What it does takes the same time in ticks of any length.",
     &runs_and_rests_by_the_clock, "law.sound", long_time},
};

}  // namespace

std::span<const Test> physics_parameter_tests() { return tests; }

}  // namespace kerf::conformance
