// SPDX-License-Identifier: Apache-2.0
// Torque of the screw of plugins/implant: twelve measured screws, signs, clamp force, loop rates, work, and its ticks.
//
//     bench_screw [FOLDER]   prints what was found; writes screw-torque.svg into the folder
//
// For training and research; not for diagnosis, planning or deciding treatment.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "studies/drawing/plot.h"
#include "studies/rank_correlation.h"
#include "studies/times.h"
#include "tests/plugins/implant/weidling.h"
#include "tests/support/turned_screw.h"
#include "text/write_file.h"

namespace {

using namespace kerf;
using namespace literals;
using test::ScrewScene;
using test::TurnedScrew;

constexpr double turn = 2.0 * pi;     // [rad]
constexpr double fast = 2.0 * turn;   // [rad/s]
constexpr double by_hand = 0.5 * pi;  // [rad/s] 15 rpm

// ---- twelve measured screws ------------------------------------------------------------------------------------

constexpr std::size_t screws = std::size(test::weidling), half = screws / 2;
using PerScrew = std::array<double, screws>;

/// Nothing is set for one screw that the others do not have: 25 mm of thread, no flutes.
double torque_of(const test::MeasuredScrew& s) {
    // 1 mm more than is inserted: the head stays clear. The tip's cone is as long as the core is wide.
    TurnedScrew screw({.density = test::weidling_density,
                       .set = {{"outer_diameter", s.outer},
                               {"core_diameter", s.core},
                               {"tip_core_diameter", s.core},
                               {"pitch", s.pitch},
                               {"thread_length", s.core + 26.0_mm},
                               {"flutes", 0.0},
                               {"flute_length", 0.0},
                               {"head_diameter", 12.0_mm}},
                       .thickness = 40.0_mm,
                       .hole_radius = test::pilot_radius_of(s)});
    screw.insert(25.0_mm / s.pitch, fast);
    return screw.torque();
}

/// Mean absolute relative error of the six screws that are not in `fitted`, with the one factor that fits those in
/// `fitted` best: least squares of relative errors. `ratio`: found over measured.
double error_of_the_others(const PerScrew& ratio, std::uint32_t fitted) {
    double sum = 0.0, squares = 0.0, error = 0.0;
    for (std::size_t i = 0; i < screws; ++i)
        if ((fitted >> i & 1U) != 0) {
            sum += ratio[i];
            squares += ratio[i] * ratio[i];
        }
    const double factor = sum / squares;
    for (std::size_t i = 0; i < screws; ++i)
        if ((fitted >> i & 1U) == 0) error += std::abs(factor * ratio[i] - 1.0) / half;
    return error;
}

void print_halves(const char* name, const PerScrew& found, const PerScrew& measured) {
    PerScrew ratio{};
    for (std::size_t i = 0; i < screws; ++i) ratio[i] = found[i] / measured[i];
    std::vector<double> errors;
    for (std::uint32_t fitted = 0; fitted < 1U << screws; ++fitted)
        if (std::popcount(fitted) == static_cast<int>(half)) errors.push_back(error_of_the_others(ratio, fitted));
    std::sort(errors.begin(), errors.end());
    const std::size_t n = errors.size();
    double mean = 0.0;
    for (const double e : errors) mean += e / static_cast<double>(n);
    const double median = 0.5 * (errors[(n - 1) / 2] + errors[n / 2]);
    const double ninth = errors[static_cast<std::size_t>(std::ceil(0.9 * static_cast<double>(n))) - 1];
    std::printf("  %-28s %zu ways: median %.1f %%, mean %.1f %%, 90th percentile %.1f %%; rank correlation %.2f\n",
                name, n, 100.0 * median, 100.0 * mean, 100.0 * ninth, rank_correlation(found, measured));
}

void measured_screws() {
    PerScrew law{}, contact{}, measured{};
    double error = 0.0, worst = 0.0;
    std::printf("Twelve screws, 25 mm in foam of %.1f kg/m3 [weidling-2022]: torque [N m]\n", test::weidling_density);
    for (std::size_t i = 0; i < screws; ++i) {
        const test::MeasuredScrew& s = test::weidling[i];
        measured[i] = s.torque;
        law[i] = torque_of(s);
        contact[i] = s.contact * 0.25 * (s.outer + s.core);
        const double off = law[i] / s.torque - 1.0;
        error += std::abs(off) / screws;
        worst = std::max(worst, std::abs(off));
        std::printf("  %-8s measured %.2f, found %.2f (%+.0f %%)\n", s.name, s.torque, law[i], 100.0 * off);
    }
    std::printf("  nothing fitted: mean error %.1f %%, largest %.0f %%\n", 100.0 * error, 100.0 * worst);
    std::printf("One factor fitted to six screws; mean error of the other six:\n");
    print_halves("law of the plugin", law, measured);
    print_halves("contact area x mean radius", contact, measured);
}

// ---- signs -----------------------------------------------------------------------------------------------------

void signs() {
    constexpr double density = 320.0;  // [kg/m³], 20 pcf
    const auto torque = [](ScrewScene scene) {
        const double lead = (scene.set.contains("starts") ? scene.set.at("starts") : 1.0) * 2.75_mm;
        TurnedScrew screw(scene);
        screw.insert(24.0_mm / lead, fast);
        return screw.torque();
    };
    const double plain = torque({.density = density});
    std::printf("24 mm in %.0f kg/m3, two flutes of 6 mm, pilot hole of 3 mm: %.3f N m\n", density, plain);
    const auto row = [&](const char* change, const char* wanted, ScrewScene scene) {
        const double other = torque(std::move(scene));
        std::printf("  %-32s %.3f N m, %s (%s)\n", change, other, other < plain ? "lower" : "higher", wanted);
    };
    row("three flutes", "measured: lower [wu-2022]", {.density = density, .set = {{"flutes", 3.0}}});
    row("flutes of 10 mm", "measured: lower [wu-2022]", {.density = density, .set = {{"flute_length", 10.0_mm}}});
    row("double lead", "measured: higher [wu-2022]", {.density = density, .set = {{"starts", 2.0}}});
    row("pilot hole of 4.8 mm", "expected: lower", {.density = density, .hole_radius = 2.4_mm});
    row("25 % denser bone", "expected: higher", {.density = 1.25 * density});
}

// ---- clamp force -----------------------------------------------------------------------------------------------

/// C.10: T = F (P/2π + μ r_t/cos β + μ_h r_h).
void clamp_torque() {
    TurnedScrew screw({.density = 700.0, .set = {{"thread_length", 25.0_mm}}});
    screw.insert(6.0, fast);
    screw.tighten(1.0, by_hand);
    const double going_in = screw.torque();
    screw.tighten(1000.0, by_hand);
    const double found = screw.torque() - going_in, clamp = screw.clamp();
    const auto of = [&](const char* id) { return test::parameter(screw.rig().setup(), id); };
    const double core = 0.5 * (of("core_diameter") + of("tip_core_diameter"));  // in the middle of the thread
    const double thread_radius = 0.25 * (of("outer_diameter") + core),
                 head_radius = 0.25 * (of("outer_diameter") + of("head_diameter"));
    const double bolt = clamp * (screw.advance() + of("friction") * thread_radius / std::cos(of("flank_angle")) +
                                 of("head_friction") * head_radius);
    std::printf("Clamp of %.0f N: %.2f N m above the %.2f N m of going in; a bolt's formula gives %.2f N m (%+.1f %%; "
                "bar 5 %%)\n",
                clamp, found, going_in, bolt, 100.0 * (found / bolt - 1.0));
}

// ---- loop rates ------------------------------------------------------------------------------------------------

/// Torque of the bone at equal steps of the driver's angle: going in, seating, tightening, stripping.
std::vector<double> torques_at(double rate) {
    const ToolSetup setup = test::screw_setup({{"thread_length", 25.0_mm}});
    const Body body = test::pilot_block(250.0, 40.0_mm, 0.5 * test::parameter(setup, "tip_core_diameter"));
    test::HandOnDriver hand(body, setup, 1.0 / rate);
    std::vector<double> torques;
    for (double next = 0.1; next < 12.0 * turn; next += 0.1) {
        while (hand.angle() < next - 1e-9) (void)hand.tick(by_hand);
        torques.push_back(test::signal(hand.simulation(), "torque"));
    }
    return torques;
}

void loop_rates() {
    const std::vector<double> reference = torques_at(1000.0);
    const double largest = *std::max_element(reference.begin(), reference.end());
    std::printf("Torque over angle by hand at 15 rpm, from air until it is stripped; largest %.2f N m\n", largest);
    for (const double rate : {500.0, 2000.0, 4000.0}) {
        const std::vector<double> other = torques_at(rate);
        double apart = 0.0;
        std::size_t at = 0;
        for (std::size_t i = 0; i < reference.size(); ++i)
            if (const double d = std::abs(other[i] - reference[i]); d > apart) apart = d, at = i;
        std::printf("  %4.0f Hz: at most %.2f %% of it from 1000 Hz, after %.2f turns (bar 2 %%)\n", rate,
                    100.0 * apart / largest, 0.1 * static_cast<double>(at + 1) / turn);
    }
}

// ---- work ------------------------------------------------------------------------------------------------------

/// Work of each kind of channel [J], counted as the law's `commit` receives it. A law's table has no context, so there
/// is one meter.
struct Meter {
    const kerf_force* law = nullptr;
    std::array<double, 4> work{};  ///< by kind: cut, contact, friction, hold

    [[nodiscard]] double sum() const { return work[0] + work[1] + work[2] + work[3]; }
};
Meter meter;

kerf_status metered_commit(const kerf_tick_in* in, const kerf_advance* advance, void* state, kerf_commit_out* out) {
    for (std::uint32_t c = 0; c < advance->channel_count; ++c) {
        double rate = 0.0;
        for (std::size_t i = 0; i < 6; ++i) rate += advance->channel[c].d[i] * advance->rate[i];
        meter.work[advance->channel[c].kind] += advance->lambda[c] * rate * in->dt;
    }
    return meter.law->commit(in, advance, state, out);
}

/// A hand turns the driver at 15 rpm and pushes until the head's force is 300 N. Its work is that of the wrench on the
/// hand along the handle's path; the bone's is that of the channels. Neither reads the other.
void work_ledger() {
    ToolSetup setup = test::screw_setup({{"thread_length", 30.0_mm}});
    const Body body = test::pilot_block(300.0, 40.0_mm, 0.5 * test::parameter(setup, "tip_core_diameter"));
    kerf_component component = *setup.force;
    kerf_force metered = *component.force;
    meter = {.law = setup.force->force};
    metered.commit = &metered_commit;
    component.force = &metered;
    setup.force = &component;

    test::HandOnDriver driver(body, setup);
    const Simulation& simulation = driver.simulation();
    double by_torque = 0.0, by_push = 0.0, by_signals = 0.0, turned = 0.0;
    Vec6 on_hand{};
    for (int tick = 0; tick < 120'000 && test::signal(simulation, "clamp") < 300.0; ++tick) {
        const Pose last = driver.handle();
        on_hand = driver.tick(by_hand).limited_on_hand;
        const Pose& now = driver.handle();
        by_push -= dot(linear(on_hand), now * driver.grip() - last * driver.grip());
        by_torque -= dot(angular(on_hand), small_rotation_vector(now.rotation * conjugate(last.rotation)));

        const double angle = test::signal(simulation, "turned");
        by_signals += test::signal(simulation, "torque") * (angle - turned);
        turned = angle;
    }
    const Spring& spring = driver.spring();
    const double force = linear(on_hand).z, torque = angular(on_hand).z;
    const double stored =
        0.5 * force * force / spring.stiffness.along + 0.5 * torque * torque / spring.turn_stiffness.along;
    const double hand = by_torque + by_push, bone = meter.sum();
    std::printf("Work of an insertion by hand, %.1f turns, up to a clamp of %.0f N:\n", turned / turn,
                test::signal(simulation, "clamp"));
    std::printf("  hand:  torque %.2f J, push %.2f J, together %.2f J\n", by_torque, by_push, hand);
    std::printf("  bone:  friction %.2f J, thread's grip %.2f J, cutting %.2f J, contacts %.2f J, together %.2f J\n",
                meter.work[KERF_FRICTION], meter.work[KERF_HOLD], meter.work[KERF_CUT], meter.work[KERF_CONTACT], bone);
    std::printf("  the spring between them stores %.3f J; hand - bone - spring is %+.3f %% of the hand's (bar 2 %%)\n",
                stored, 100.0 * (hand - bone - stored) / hand);
    std::printf("  the signals `torque` and `turned` alone give %.2f J of the torque's\n", by_signals);
}

// ---- the picture -----------------------------------------------------------------------------------------------

struct Turned {
    double angle, torque;  ///< [rad] since the head seated, [N·m]
};

/// A screw turned until its thread holds nothing.
std::vector<Turned> stripped_screw() {
    constexpr double length = 30.0_mm;
    TurnedScrew screw({.density = 300.0, .set = {{"thread_length", length}}});
    std::vector<Turned> path;
    double seat = 0.0;  // [rad]
    while (screw.angle() < 20.0 * turn && !(screw.has_seen("implant.stripped") && screw.torque() < 0.1)) {
        const bool is_near_seat = screw.depth() > length - 1.0_mm;
        screw.turn(is_near_seat ? 0.05 : 0.5, is_near_seat ? by_hand : fast);
        if (screw.turned() > 0.0) path.push_back({screw.turned(), screw.torque()});
        if (seat == 0.0 && screw.has_seen("implant.head_contact")) seat = screw.turned();
    }
    for (Turned& at : path) at.angle -= seat;
    return path;
}

drawing::Curve curve_of(const std::vector<Turned>& path, std::size_t end, const char* name, int colour, double low,
                        double unit) {
    drawing::Curve curve{.name = name, .colour = colour, .is_bold = true, .has_dots = false};
    for (std::size_t i = 0; i <= end; ++i)
        if (path[i].angle >= low) curve.markers.push_back({.x = path[i].angle / unit, .y = path[i].torque});
    return curve;
}

/// Three hands turn the same screw in the same bone: one stops at 80 % of the largest torque, before the thread yields,
/// one at the largest, one not at all. Until they stop, their paths are the same.
std::string picture() {
    const std::vector<Turned> path = stripped_screw();
    const auto less = [](const Turned& a, const Turned& b) { return a.torque < b.torque; };
    const auto peak = std::max_element(path.begin(), path.end(), less);
    const auto stop =
        std::find_if(path.begin(), peak, [&](const Turned& at) { return at.torque >= 0.8 * peak->torque; });
    struct End {
        const char* name;
        int colour;
        std::size_t at;
    };
    // The longest is drawn first, so that the shorter ones lie on it.
    const std::array<End, 3> ends{{{"stripped", 8, path.size() - 1},
                                   {"overtightened", 3, static_cast<std::size_t>(peak - path.begin())},
                                   {"good", 0, static_cast<std::size_t>(stop - path.begin())}}};
    for (const End& end : ends)
        std::printf("Picture: %-13s ends at %.2f N m, %.0f deg after the head seated\n", end.name, path[end.at].torque,
                    path[end.at].angle / 1.0_deg);

    const auto panel = [&](const char* title, const char* x, double low, double high, double unit) {
        drawing::Panel drawn{.title = title,
                             .x = {x, false, low / unit, high / unit},
                             .y = {"torque [N m]", false, 0.0, std::ceil(peak->torque)}};
        for (const End& end : ends) drawn.curves.push_back(curve_of(path, end.at, end.name, end.colour, low, unit));
        drawn.x.guides.push_back({0.0, "head seats"});
        return drawn;
    };
    constexpr double width = 560, height = 340;
    return drawing::picture(
        2.0 * width + 20.0, height + 20.0, "Torque of a screw over the angle",
        panel_svg(panel("Torque of a screw", "turns since the head seated", -10.0 * turn, 2.0 * turn, turn), 10.0, 10.0,
                  width, height) +
            panel_svg(panel("Its last turn", "angle since the head seated [deg]", -90.0_deg, 360.0_deg, 1.0_deg),
                      10.0 + width, 10.0, width, height));
}

// ---- a tick ----------------------------------------------------------------------------------------------------

/// Whole ticks in the same run, by turns: of a screw with 192 places on its thread and as many beside its core, most of
/// them in bone, and of the drill that makes its hole.
void tick_times() {
    const ToolSetup setup = test::screw_setup();
    const Body body = test::pilot_block(250.0, 55.0_mm, 0.5 * test::parameter(setup, "tip_core_diameter"));
    test::HandOnDriver driver(body, setup);
    while (test::signal(driver.simulation(), "turned") < 13.0 * turn) static_cast<void>(driver.tick(fast));

    const Body block = test::pilot_block(250.0, 55.0_mm, 0.0);
    const ToolSetup drill = test::twist_drill();
    Simulation drilling(block, drill, test::outline(drill), in_hands(test::gains()), test::at_depth(-0.5_mm));
    double depth = -0.5_mm;
    const auto feed = [&] { return DeviceSample{test::at_depth(depth += 1e-6)}; };
    while (depth < 12.0_mm) static_cast<void>(drilling.tick(feed()));

    std::vector<double> of_screw, of_drill;
    const auto timed = [](Simulation& simulation, const DeviceSample& sample, std::vector<double>& times) {
        times.push_back(time_of([&] { static_cast<void>(simulation.loop().tick(sample)); }));
        simulation.follow();
    };
    for (int n = 0; n < 4000; ++n) {
        timed(driver.simulation(), driver.next(by_hand), of_screw);
        timed(drilling, feed(), of_drill);
    }
    const Times screw = times_of(of_screw), drilled = times_of(of_drill);
    std::printf("A whole tick, median and p99.9: screw with 384 places %.1f and %.1f us, drill %.1f and %.1f us\n\n",
                screw.median, screw.p999, drilled.median, drilled.p999);
}

}  // namespace

int main(int argc, char** argv) {
    measured_screws();
    signs();
    clamp_torque();
    loop_rates();
    work_ledger();
    tick_times();
    if (argc < 2) return 0;
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    if (const std::string error = text::write_file(folder / "screw-torque.svg", picture()); !error.empty()) {
        std::fprintf(stderr, "%s\n", error.c_str());
        return 1;
    }
    return 0;
}
