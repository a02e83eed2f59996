// SPDX-License-Identifier: Apache-2.0
// Level 4: a law over its parameters, drives, feeds and ticks: for size, and not only for soundness.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "conformance/law_probe.h"
#include "conformance/parameter_sets.h"
#include "conformance/test_groups.h"
#include "core/plugin/unit.h"

namespace kerf::conformance {

namespace {

double against(const Response& response, const Vec6& rate) {
    return -dot(response.force(), (1.0 / length(linear(rate))) * linear(rate));
}

// ---- parameters ---------------------------------------------------------------------------------------------------

/// What a law makes with one set of parameters [N]: fed, moved across, pressed on at rest. Negative where it does not
/// cut, as with a motor that is too weak.
using Sizes = std::array<double, 3>;
constexpr const char* name_of_size[] = {"fed in solid bone", "moved along +x in solid bone",
                                        "pressed 0.1 mm into bone at rest"};

/// A parameter of the tool or the law, and what the law makes of its values.
class Sweep {
public:
    Sweep(const Subject& subject, bool is_of_tool, std::uint32_t index)
        : subject_(subject), is_of_tool_(is_of_tool), index_(index) {}
    [[nodiscard]] const kerf_param& row() const { return component().params[index_]; }
    /// Returns whether the tool can be made with it.
    bool at(double value, Sizes& sizes) const {
        WalkSettings settings = solid_bone();
        std::vector<double> values;
        for (std::uint32_t i = 0; i < component().param_count; ++i) values.push_back(component().params[i].def);
        values[index_] = value;
        (is_of_tool_ ? settings.tool_parameters : settings.force_parameters) = values;
        LawProbe running(subject_, settings);
        if (!running.refusal().empty()) return false;
        const auto size = [&](const Vec6& rate) {
            const Response r = running.move(at_depth(0), rate, 2);  // a motor stalls later
            return subject_.tool->tool->drive_count > 0 && r.cut_ticks < r.ticks ? -1.0 : length(r.force());
        };
        sizes[0] = size(running.feed(probe_speed));
        sizes[1] = size({probe_speed, 0, 0, 0, 0, 0});
        settings.bone.shape = PlaneBone::Shape::plate;
        settings.drives = drives_at_rest(*subject_.tool);
        LawProbe resting(subject_, settings);
        sizes[2] = resting.evaluate(at_depth(0.1e-3)) ? length(linear(resting.law().force_at({}))) : 0.0;
        return true;
    }
    [[nodiscard]] std::string named(double value) const {
        const auto unit = parse_unit(row().display_unit);
        return "`" + std::string(row().id) + "` " + number(unit ? value / unit->factor : value) +
               (*row().display_unit != '\0' ? " " : "") + row().display_unit;
    }

private:
    [[nodiscard]] const kerf_component& component() const { return is_of_tool_ ? *subject_.tool : *subject_.force; }
    const Subject& subject_;
    bool is_of_tool_;
    std::uint32_t index_;
};

bool is_count(const kerf_param& row) {
    return *row.display_unit == '\0' && std::trunc(row.min) == row.min && std::trunc(row.max) == row.max &&
           std::trunc(row.def) == row.def;
}

/// How often one size is the other, if both are worth it: more than `slight` [N].
double ratio_of(double a, double b, double slight) {
    return std::max({a, b, slight}) / std::max(std::min(a, b), slight);
}

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

/// Two values of a parameter and their sizes.
struct Interval {
    double low, high;
    Sizes of_low, of_high;

    [[nodiscard]] double ratio(std::size_t which, double slight) const {
        return ratio_of(of_low[which], of_high[which], slight);
    }
};

/// Narrows an interval down on a jump of the force. Returns its text, empty without one.
std::string jump_in(const Sweep& sweep, std::size_t which, Interval in, double slight) {
    constexpr double jump = 2.5;  // [–] in the narrowest interval: more than a motor that stalls makes
    for (int i = 0; i < 9 && in.ratio(which, slight) > jump; ++i) {
        Sizes between{};
        const double middle =
            in.low > 0.0 && in.high > 20.0 * in.low ? std::sqrt(in.low * in.high) : 0.5 * (in.low + in.high);
        if (!sweep.at(middle, between) || between[which] < 0.0) return {};
        const bool is_below =
            ratio_of(in.of_low[which], between[which], slight) > ratio_of(between[which], in.of_high[which], slight);
        (is_below ? in.high : in.low) = middle;
        (is_below ? in.of_high : in.of_low) = between;
    }
    if (in.ratio(which, slight) <= jump || std::min(in.of_low[which], in.of_high[which]) < 0.0) return {};
    return "With " + sweep.named(in.low) + " it makes " + number(in.of_low[which]) + " N, and with " +
           sweep.named(in.high) + " " + number(in.of_high[which]) + " N, " + name_of_size[which] +
           ", expected no jump.";
}

/// The first jump along a parameter's range; empty without one.
std::string jump_along(const Sweep& sweep) {
    constexpr double suspicious = 3.0;  // [–] between neighbours
    const std::vector<double> values = values_over(sweep.row());
    std::vector<Sizes> sizes(values.size());
    std::vector<bool> is_made;
    for (std::size_t i = 0; i < values.size(); ++i) is_made.push_back(sweep.at(values[i], sizes[i]));
    for (std::size_t which = 0; which < 3; ++which) {
        double largest = 0.0;
        for (const Sizes& one : sizes) largest = std::max(largest, one[which]);
        const double slight = std::max(0.1 * largest, 1e-9);
        for (std::size_t i = 0; i + 1 < values.size(); ++i) {
            const Interval in{values[i], values[i + 1], sizes[i], sizes[i + 1]};
            if (!is_made[i] || !is_made[i + 1] || std::min(in.of_low[which], in.of_high[which]) < 0.0) continue;
            if (in.ratio(which, slight) < suspicious) continue;
            if (std::string text = jump_in(sweep, which, in, slight); !text.empty()) return text;
        }
    }
    return {};
}

void varies_smoothly(Examination& exam) {
    for (const bool is_of_tool : {true, false}) {
        const kerf_component& component = is_of_tool ? *exam.subject->tool : *exam.subject->force;
        for (std::uint32_t p = 0; p < component.param_count; ++p) {
            if (is_count(component.params[p])) continue;
            if (const std::string text = jump_along({*exam.subject, is_of_tool, p}); !text.empty())
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
            const Sweep sweep(*exam.subject, is_of_tool, p);
            const double lowest = sweep.row().min, width = sweep.row().max - lowest;
            const double value[] = {lowest, lowest + 0.1 * width, lowest + 0.25 * width, lowest + 0.9 * width,
                                    lowest + width};
            std::array<Sizes, 5> sizes{};
            bool is_made = true;
            for (std::size_t i = 0; i < 5 && is_made; ++i) is_made = sweep.at(value[i], sizes[i]);
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
    std::vector<Vec6> motions{probe.feed(1.0)};
    if (exam.subject->tool->tool->feed == KERF_FEED_AXIS && !probe.is_threaded())
        for (const Vec3 v : {Vec3{1, 0, 0}, Vec3{0, 1, 0}}) motions.push_back(make_vec6(v, {}));
    for (const Vec6& motion : motions) {
        double before = 0.0, rate_before = 0.0;
        for (const double r : rates) {
            Vec6 rate = motion;
            for (double& part : rate) part *= r;
            const Response response = probe.move(at_depth(0), rate);
            if (exam.subject->tool->tool->drive_count > 0 && response.cut_ticks < response.ticks) break;  // it stalls
            const double force = against(response, rate);
            if (force < 0.97 * before)
                return exam.fail("Moved along " + name_of_direction(linear(motion)) + " in solid bone at " +
                                 number(1e3 * r) + " mm/s, it is resisted with " + number(force) + " N, and with " +
                                 number(before) + " N at " + number(1e3 * rate_before) +
                                 " mm/s, expected no less at the faster feed.");
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
