// SPDX-License-Identifier: Apache-2.0
// Level 4: what a law does with its tool in bone, in a simulation of the host.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "conformance/law_walk.h"
#include "conformance/test_groups.h"
#include "conformance/tool_rig.h"
#include "kerf/units.hpp"

namespace kerf::conformance {

namespace {

constexpr double feed_rate = 2e-3;  // [m/s]
constexpr double slight = 0.05;     // [N] a force that no hand notices

bool has_drives(const Subject& subject) { return subject.tool->tool->drive_count > 0; }

bool is_fault(Examination& exam, const TickResult& tick, const ToolRig&) {
    if (tick.is_quarantined) exam.fail("The host releases the force: the law is unsound, or no motion balances it.");
    return tick.is_quarantined;
}

double mean_thrust(const ToolRig& rig, const std::vector<TickResult>& ticks, double share) {
    const std::size_t from = ticks.size() - static_cast<std::size_t>(share * static_cast<double>(ticks.size()));
    double sum = 0.0;
    for (std::size_t i = from; i < ticks.size(); ++i) sum += rig.thrust(ticks[i]);
    return sum / static_cast<double>(ticks.size() - from);
}

/// The thrust of a tool that is led to its working depth, over the last fifth of its way.
struct Fed {
    double thrust = 0.0;   ///< [N]
    double removed = 0.0;  ///< [m³]
};
Fed fed(const Subject& subject, const RigSettings& settings, double speed = feed_rate) {
    ToolRig rig(subject, settings);
    rig.run_up();
    Fed result;
    result.thrust = mean_thrust(rig, rig.feed(-above, rig.working_depth(), speed), 0.2);
    result.removed = rig.removed();
    return result;
}

std::string percent(double share) { return number(100.0 * share) + " %"; }

// ---- at rest ------------------------------------------------------------------------------------------------------

void touches_where_bone_is(Examination& exam) {
    ToolRig rig(*exam.subject, {.is_running = false});
    double most = 0.0;
    for (const TickResult& tick : rig.feed(-above, -0.1e-3, feed_rate))
        most = std::max(most, std::abs(rig.thrust(tick)));
    if (most > slight)
        exam.fail("At rest it makes a force of " + number(most) +
                  " N while its tip is still 0.1 mm above the bone, expected none.");
}

void rests_on_bone(Examination& exam) {
    constexpr double push = 10.0, max_depth = 1.5e-3;  // [N], [m]
    ToolRig rig(*exam.subject, {.is_running = false});
    TickResult tick;
    for (int i = 0; i < 1500; ++i)
        if (is_fault(exam, tick = rig.push(push), rig)) return;
    const double depth = rig.depth();
    if (depth > max_depth)
        exam.fail("At rest, pushed with 10 N, its tip sinks " + number(1e3 * depth) + " mm into dense bone, expected " +
                  number(1e3 * max_depth) + " mm at most. Add contact for a tool that does not cut.");
    else
        exam.note(number(1e3 * depth) + " mm deep under 10 N");
}

void settles(Examination& exam) {
    constexpr double push = 10.0;
    ToolRig rig(*exam.subject, {.is_running = false});
    for (int i = 0; i < 1500; ++i)
        if (is_fault(exam, rig.push(push), rig)) return;
    double least = 1e300, most = -1e300;
    for (int i = 0; i < 200; ++i) {
        const double thrust = rig.thrust(rig.push(push));
        least = std::min(least, thrust);
        most = std::max(most, thrust);
    }
    if (most - least > 0.05 * push)
        exam.fail("At rest, under a steady push of 10 N, the force on the hand runs between " + number(least) +
                  " N and " + number(most) + " N and does not settle, expected one force to 0.5 N.");
}

/// Work of the bone on the tool along ticks [J].
class Work {
public:
    Work(const ToolRig& rig, const Pose& from) : rig_(rig), last_(from) {}
    void add(const TickResult& tick) {
        const Vec3 force = linear(tick.bone_on_tool);
        const Pose& now = tick.world_from_tool;
        const Vec3 turned = rotate(last_.rotation, small_rotation_vector(conjugate(last_.rotation) * now.rotation));
        sum_ += 0.5 * dot(force + force_, now.position - last_.position) +
                0.5 * dot(angular(tick.bone_on_tool) + torque_, turned);
        stored_ = std::min(stored_, sum_);
        force_ = force;
        torque_ = angular(tick.bone_on_tool);
        last_ = now;
    }
    [[nodiscard]] double sum() const noexcept { return sum_; }
    [[nodiscard]] double max_taken() const noexcept { return -stored_; }

private:
    const ToolRig& rig_;
    Pose last_;
    Vec3 force_{}, torque_{};
    double sum_ = 0.0, stored_ = 0.0;
};

void is_passive(Examination& exam) {
    constexpr double deep = 0.1e-3, step = 0.1e-6;  // [m] of a tick: what a step adds by its length is not the law's
    constexpr double max_share = 0.05;              // [–] of what it stored
    for (const double tilt : {0.0, 20.0 * pi / 180.0}) {
        ToolRig rig(*exam.subject, {.is_running = false});
        static_cast<void>(rig.lead(-0.1e-3, 0.0, tilt));
        Work work(rig, rig.simulation().world_from_tool());
        const int count = static_cast<int>(std::lround((deep + 0.1e-3) / step));
        for (int i = 1; i <= 2 * count; ++i)
            work.add(rig.lead(-0.1e-3 + step * (i <= count ? i : 2 * count - i), 0.0, tilt));
        if (work.sum() > max_share * work.max_taken() + 1e-9)
            return exam.fail("At rest, pressed 0.1 mm into bone and drawn back, it gives the hand " +
                             number(1e3 * work.sum()) + " mJ that it was never given, expected none; it stored " +
                             number(1e3 * work.max_taken()) + " mJ at most.");
    }
}

void is_mirrored(Examination& exam) {
    constexpr double tilt = 20.0 * pi / 180.0;
    const auto pressed = [&](double by) {
        ToolRig rig(*exam.subject, {.is_running = false});
        Vec3 force{};
        for (int i = 0; i <= 100; ++i) force = rig.force_in_block(rig.lead(-0.1e-3 + 2e-6 * i, 0.0, by));
        return force;
    };
    const Vec3 right = pressed(tilt), left = pressed(-tilt);
    const double size = length(right), apart = length(Vec3{right.x + left.x, right.y - left.y, right.z - left.z});
    // The mirror of a force across the plane of the tilt keeps its y only where there is none.
    if (apart > 0.05 * size + slight)
        exam.fail(
            "At rest, pressed on with 20° of tilt to one side and to the other, its forces are no mirror images: (" +
            number(right.x) + ", " + number(right.y) + ", " + number(right.z) + ") N and (" + number(left.x) + ", " +
            number(left.y) + ", " + number(left.z) + ") N.");
}

// ---- at work ------------------------------------------------------------------------------------------------------

void gains_nothing(Examination& exam) {
    ToolRig rig(*exam.subject, {});
    rig.run_up();
    Work work(rig, rig.simulation().world_from_tool());
    const double deep = rig.working_depth();
    for (const TickResult& tick : rig.feed(-above, deep, feed_rate)) work.add(tick);
    const double in = work.sum();
    for (const TickResult& tick : rig.feed(deep, -above, 10.0 * feed_rate)) work.add(tick);
    const double taken = work.max_taken();
    if (in > 0.01 * taken + 1e-6)
        exam.fail("Fed straight into bone, it pulls itself in: it gives the hand " + number(1e3 * in) +
                  " mJ, expected none. Cutting costs work.");
    else if (work.sum() > 0.01 * taken + 1e-6)
        exam.fail("Fed straight into bone and drawn out, it gives the hand " + number(1e3 * work.sum()) +
                  " mJ, expected none.");
    else
        exam.note("takes " + number(-1e3 * work.sum()) + " mJ of the hand");
}

void gains_nothing_sideways(Examination& exam) {
    constexpr double aside = 1.5e-3;  // [m]
    for (const double side : {1.0, -1.0}) {
        ToolRig rig(*exam.subject, {});
        rig.run_up();
        const double deep = std::min(rig.working_depth(), 2e-3), step = feed_rate * rig.period();
        static_cast<void>(rig.feed(-above, deep, feed_rate));
        Work work(rig, rig.simulation().world_from_tool());
        const int count = static_cast<int>(aside / step);
        for (int i = 1; i <= 2 * count; ++i) work.add(rig.lead(deep, side * step * (i <= count ? i : 2 * count - i)));
        if (work.sum() > 0.01 * work.max_taken() + 1e-6)
            return exam.fail("Led 1.5 mm sideways through bone and back, it gives the hand " +
                             number(1e3 * work.sum()) + " mJ, expected none. Cutting costs work.");
    }
}

void knows_no_ghosts(Examination& exam) {
    ToolRig rig(*exam.subject, {.spacing = 0.2e-3});
    rig.run_up();
    const double deep = rig.working_depth();
    const double steady = mean_thrust(rig, rig.feed(-above, deep, feed_rate), 0.2);
    if (steady < slight) return exam.skip("it makes no thrust in bone");
    for (const TickResult& tick : rig.feed(deep, -above, 5.0 * feed_rate)) static_cast<void>(tick);
    for (int i = 0; i < 100; ++i) static_cast<void>(rig.lead(-above));
    double most = 0.0;
    for (const TickResult& tick : rig.feed(-above, deep - 0.5e-3, feed_rate)) most = std::max(most, rig.thrust(tick));
    const double allowed = std::max(slight, 0.03 * steady);
    if (rig.removed() > 0.0 && most > allowed)
        exam.fail("On its way back into the hole that it has made, it meets " + number(most) +
                  " N of bone that is no longer there, expected " + number(allowed) +
                  " N at most; in solid bone it meets " + number(steady) + " N.");
}

/// Returns the largest step of force within a tick when the tool, at rest, meets bone at the feed rate [N]: a hand that
/// leans on meets as much when contact takes over from cutting.
double step_of_contact(const Subject& subject) {
    constexpr double deep = 30e-6, bound = 1.5;  // [m], [N] of a contact of 750 N/mm
    ToolRig rig(subject, {.is_running = false});
    double last = 0.0, largest = 0.0;
    for (const TickResult& tick : rig.feed(-above, deep, feed_rate)) {
        largest = std::max(largest, std::abs(rig.thrust(tick) - last));
        last = rig.thrust(tick);
    }
    return std::min(largest, bound);
}

void hands_over(Examination& exam) {
    if (!has_drives(*exam.subject)) return exam.skip("the tool has no drive");
    constexpr double max_step = 0.1;                                    // [–] of the push
    const double push = std::min(30.0, fed(*exam.subject, {}).thrust);  // [N] so that it cuts at about 2 mm/s
    if (push < slight) return exam.skip("it makes no thrust in bone");
    const double allowed = std::max(step_of_contact(*exam.subject), max_step * push);
    ToolRig rig(*exam.subject, {});
    rig.run_up();
    for (int i = 0; i < 800; ++i)
        if (is_fault(exam, rig.push(push), rig)) return;
    const auto largest_step = [&](double fraction) {
        rig.drive(fraction);
        double last = rig.thrust(rig.push(push)), largest = 0.0;
        for (int i = 0; i < 1500; ++i) {
            const double thrust = rig.thrust(rig.push(push));
            largest = std::max(largest, std::abs(thrust - last));
            last = thrust;
        }
        return largest;
    };
    for (const double fraction : {0.0, 1.0})
        if (const double step = largest_step(fraction); step > allowed)
            return exam.fail(std::string("Switched ") + (fraction > 0.0 ? "on" : "off") + " under a push of " +
                             number(push) + " N, its force steps by " + number(step) +
                             " N from one tick to the next. Let the cut fade while contact takes over "
                             "(kerf/powered_cutter.hpp).");
}

void does_not_know_the_rate(Examination& exam) {
    const Fed at_1_khz = fed(*exam.subject, {});
    for (const double period : {2e-3, 0.5e-3, 0.25e-3}) {
        const Fed other = fed(*exam.subject, {.period = period});
        const double thrust = std::abs(other.thrust - at_1_khz.thrust);
        if (thrust > 0.03 * std::abs(at_1_khz.thrust) + slight)
            return exam.fail("Fed at 2 mm/s, it makes " + number(at_1_khz.thrust) + " N at 1000 Hz and " +
                             number(other.thrust) + " N at " + number(1.0 / period) +
                             " Hz, expected the same within 3 %. Multiply by `dt` what counts per tick.");
        if (std::abs(other.removed - at_1_khz.removed) > 0.03 * at_1_khz.removed + 0.1e-9)
            return exam.fail("Fed at 2 mm/s, it removes " + number(1e9 * at_1_khz.removed) + " mm³ at 1000 Hz and " +
                             number(1e9 * other.removed) + " mm³ at " + number(1.0 / period) +
                             " Hz, expected the same within 3 %.");
    }
}

void does_not_know_the_grid(Examination& exam) {
    const Fed coarse = fed(*exam.subject, {.spacing = 0.4e-3}), fine = fed(*exam.subject, {.spacing = 0.2e-3});
    if (std::abs(coarse.thrust - fine.thrust) > 0.1 * std::abs(fine.thrust) + slight)
        exam.fail("Fed at 2 mm/s, it makes " + number(coarse.thrust) + " N on a grid of 0.4 mm and " +
                  number(fine.thrust) + " N on one of 0.2 mm, expected the same within 10 %.");
    else
        exam.note(number(coarse.thrust) + " N at 0.4 mm, " + number(fine.thrust) + " N at 0.2 mm");
}

void does_not_know_directions(Examination& exam) {
    const Fed straight = fed(*exam.subject, {});
    for (const Vec3 turn : {Vec3{0.4, 0.3, 0.2}, Vec3{-0.2, 0.7, 0.1}}) {
        const Fed turned = fed(*exam.subject, {.turn = quat_from_rotation_vector(turn)});
        if (std::abs(turned.thrust - straight.thrust) > 0.1 * std::abs(straight.thrust) + slight)
            return exam.fail("Fed at 2 mm/s, it makes " + number(straight.thrust) +
                             " N along an axis of the grid and " + number(turned.thrust) +
                             " N askew to it, expected the same within 10 %: bone and tool were turned together.");
    }
}

void resists_denser_bone_more(Examination& exam) {
    double last = 0.0;
    for (const double density : {600.0, 1200.0, 1850.0}) {
        const double thrust = fed(*exam.subject, {.density = density}).thrust;
        if (thrust < 0.98 * last - slight)
            return exam.fail("Fed at 2 mm/s, it makes " + number(thrust) + " N in bone of " + number(density) +
                             " kg/m³ and more, " + number(last) + " N, in softer bone, expected no more there.");
        last = thrust;
    }
}

void resists_faster_feed_more(Examination& exam) {
    double last = 0.0, last_rate = 0.0;
    for (const double rate : {0.5e-3, 1e-3, 2e-3, 4e-3}) {
        const double thrust = fed(*exam.subject, {}, rate).thrust;
        if (thrust < 0.98 * last - slight)
            return exam.fail("Fed at " + number(1e3 * rate) + " mm/s it makes " + number(thrust) + " N, and more, " +
                             number(last) + " N, at " + number(1e3 * last_rate) + " mm/s, expected no more there.");
        last = thrust;
        last_rate = rate;
    }
}

void does_not_age_in_air(Examination& exam) {
    const double fresh = fed(*exam.subject, {}).thrust;
    ToolRig rig(*exam.subject, {});
    rig.run_up();
    for (int i = 0; i < 5000; ++i) static_cast<void>(rig.lead(-above));
    const double idle = mean_thrust(rig, rig.feed(-above, rig.working_depth(), feed_rate), 0.2);
    if (std::abs(idle - fresh) > 0.01 * std::abs(fresh) + slight)
        exam.fail("After five seconds in air it makes " + number(idle) + " N in bone, expected " + number(fresh) +
                  " N: its state drifts while nothing happens.");
}

// ---- what it removes ----------------------------------------------------------------------------------------------

void removes_what_it_sweeps(Examination& exam) {
    ToolRig rig(*exam.subject, {.spacing = 0.2e-3});
    if (rig.outline().cutting_count == 0) return exam.skip("the tool has no cutting part");
    rig.run_up();
    const double depth = rig.working_depth();
    static_cast<void>(rig.feed(-above, depth, feed_rate));
    const double removed = rig.removed(), expected = rig.swept(depth);
    const std::string text = "Fed " + number(1e3 * depth) + " mm into bone" +
                             (rig.is_fed_sideways() ? ", lying on its side" : ", tip first") + ", it removes " +
                             number(1e9 * removed) + " mm³; its cutting part sweeps " + number(1e9 * expected) + " mm³";
    if (removed < 0.9 * expected)
        exam.fail(text + ". Request `cut` in each tick in which it cuts.");
    else if (const double most = rig.swept(depth, true); removed > 1.05 * most)
        exam.fail(text + (rig.outline().has_thread() ? ", with its crests " + number(1e9 * most) + " mm³." : "."));
    else
        exam.note(percent(removed / expected) + " of what it sweeps");
}

double removed_while_pushed(const Subject& subject, double fraction) {
    ToolRig rig(subject, {.spacing = 0.2e-3});
    rig.drive(fraction);
    rig.run_up();
    for (int i = 0; i < 1000; ++i) static_cast<void>(rig.push(5.0));
    return rig.removed();
}

void removes_nothing_at_rest(Examination& exam) {
    if (!has_drives(*exam.subject)) return exam.skip("the tool has no drive");
    if (const double removed = removed_while_pushed(*exam.subject, 0.0); removed > 0.05e-9)
        exam.fail("At rest, pushed with 5 N, it removes " + number(1e9 * removed) +
                  " mm³ of bone in a second, expected none.");
}

void keeps_to_its_least(Examination& exam) {
    const kerf_tool& tool = *exam.subject->tool->tool;
    double fraction = 1.0;
    for (std::uint32_t i = 0; i < tool.drive_count; ++i)
        if (tool.drives[i].least > 0.0 && tool.drives[i].def != 0.0)
            fraction = std::min(fraction, 0.5 * tool.drives[i].least / std::abs(tool.drives[i].def));
    if (fraction >= 1.0) return exam.skip("no drive declares a `least`");
    if (const double removed = removed_while_pushed(*exam.subject, fraction); removed > 0.05e-9)
        exam.fail("At half of the `least` that its drive declares, pushed with 5 N, it removes " +
                  number(1e9 * removed) + " mm³ of bone in a second, expected none.");
}

constexpr int long_time = 40;  // [s] of processor time
constexpr Test tests[] = {
    {"physics.touch", 4, Scope::law, "At rest it touches bone where bone is.", &touches_where_bone_is, "law.sound",
     long_time, KERF_DOES_NOT_REST_ON_BONE},
    {"physics.passive", 4, Scope::law, "At rest it gives back no more work than it was given.", &is_passive,
     "law.sound", long_time},
    {"physics.mirror", 4, Scope::law, "At rest it is the same to the left and to the right.", &is_mirrored, "law.sound",
     long_time, KERF_DOES_NOT_REST_ON_BONE},
    {"physics.still", 4, Scope::law, "At rest it removes nothing.", &removes_nothing_at_rest, "law.sound", long_time},
    {"physics.rest", 4, Scope::law, "At rest it rests on bone.", &rests_on_bone, "law.sound", long_time,
     KERF_DOES_NOT_REST_ON_BONE},
    {"physics.settles", 4, Scope::law, "At rest, under a steady push, it comes to rest.", &settles, "law.sound",
     long_time, KERF_DOES_NOT_REST_ON_BONE},
    {"physics.ledger", 4, Scope::law, "Cutting costs the hand work.", &gains_nothing, "law.sound", long_time},
    {"physics.ledger_sideways", 4, Scope::law, "Cutting sideways costs the hand work.", &gains_nothing_sideways,
     "law.sound", long_time, KERF_DOES_NOT_RESIST_SIDEWAYS},
    {"physics.idle", 4, Scope::law, "Time in air changes nothing.", &does_not_age_in_air, "law.sound", long_time},
    {"physics.density", 4, Scope::law, "Denser bone resists no less.", &resists_denser_bone_more, "law.sound",
     long_time, KERF_DOES_NOT_DEPEND_ON_DENSITY},
    {"physics.feed", 4, Scope::law, "Faster feed is resisted no less.", &resists_faster_feed_more, "law.sound",
     long_time},
    {"physics.loop_rate", 4, Scope::law, "Its force does not depend on the length of the tick.",
     &does_not_know_the_rate, "law.sound", long_time},
    {"physics.spacing", 4, Scope::law, "Its force does not depend on the spacing of the grid.", &does_not_know_the_grid,
     "law.sound", long_time},
    {"physics.frame", 4, Scope::law, "Its force does not depend on the directions of the grid.",
     &does_not_know_directions, "law.sound", long_time},
    {"physics.re_entry", 4, Scope::law, "It meets nothing in the hole that it has made.", &knows_no_ghosts, "law.sound",
     long_time},
    {"physics.removal", 4, Scope::law, "It removes what its cutting part sweeps.", &removes_what_it_sweeps, "law.sound",
     long_time},
    {"physics.switching", 4, Scope::law, "Its force does not step when it is switched on and off.", &hands_over,
     "law.sound", long_time, KERF_DOES_NOT_REST_ON_BONE},
    {"physics.least", 4, Scope::law, "Below the `least` of its drive it removes nothing.", &keeps_to_its_least,
     "law.sound", long_time},
};

}  // namespace

std::span<const Test> physics_tests() { return tests; }

}  // namespace kerf::conformance
