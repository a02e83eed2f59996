// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "studies/scenes/signal_of.h"
#include "studies/stability/criterion.h"
#include "studies/stability/kerf_loop.h"
#include "studies/stability/port_tick.h"
#include "studies/stability/scenes.h"
#include "studies/worst.h"

namespace kerf::stability {

namespace {

constexpr double above = -0.5e-3;                       // [m]
constexpr double full_turn = 2.0 * std::numbers::pi;    // [rad]
constexpr double turning = full_turn;                   // [rad/s] 60 rpm: a hand that hurries
constexpr double half_in = 6.0, backed_off = 2.0;       // [turns]
constexpr double max_turned = 30.0;                     // [turns] until the thread must have stripped
constexpr int held_ticks = 1000, cut_ends_after = 200;  // the flutes cut no longer: only friction is left
constexpr double work_push = 20.0;   // [N] at the bone, at which the device's force scale is set [assumed]
constexpr double max_slip = 0.1e-3;  // [m]

/// Spongy bone of a vertebra with a pilot hole that is as wide as the screw's core at its tip.
Body pilot_block(double hole_radius) {
    constexpr double half = 8e-3, thickness = 60e-3, spacing = 0.5e-3, density = 250.0;  // [m], [kg/m³]
    const Vec3 margin{6.0 * spacing, 6.0 * spacing, 6.0 * spacing};
    Grid grid = Grid::covering(Vec3{-half, -half, -thickness} - margin, Vec3{half, half, 0.0} + margin, spacing);
    grid.origin = grid.origin + spacing * Vec3{0.3, 0.1, 0.7};
    Body body;
    body.id = "block";
    body.surface = LevelSet::build(grid, [=](Vec3 p) {
        const double outside = std::max({std::abs(p.x) - half, std::abs(p.y) - half, p.z, -thickness - p.z});
        return std::max(outside, hole_radius - std::hypot(p.x, p.y));
    });
    body.materials.push_back({"spongy", density, {}});
    return body;
}

/// A hand that turns the driver and pushes on it.
class Driver {
public:
    Driver(Port& port, KerfLoop& loop) : port_(port), loop_(loop) {}

    /// One tick at `speed` [rad/s], with a push [N].
    void tick(double speed, double push) {
        loop_.turn(speed * port_.settings().period);
        turned_ += speed * port_.settings().period;
        const double before = port_.work();
        const double force = stability::tick(port_, loop_, push);
        trace_.period = port_.settings().period;
        trace_.depth.push_back(port_.depth());
        trace_.force.push_back(port_.held());
        trace_.energy.add(port_.work() - before, loop_.stored(port_.depth()));
        torque_ = loop_.last().torque;
        is_finite_ = is_finite_ && std::isfinite(force) && std::isfinite(torque_);
        if (loop_.last().has_event("implant.stripped")) is_stripped_ = true;
    }
    /// Turns by so many turns; backwards if negative.
    void turn(double turns, double push) {
        const double until = turned_ + full_turn * turns, speed = std::copysign(turning, turns);
        while (turns > 0.0 ? turned_ < until : turned_ > until) tick(speed, push);
    }
    /// Forgets the forces so far.
    void begin() { trace_ = {}; }
    [[nodiscard]] const Trace& trace() const noexcept { return trace_; }
    [[nodiscard]] double torque() const noexcept { return torque_; }  ///< [N·m] of the bone against the screw
    [[nodiscard]] double turned() const noexcept { return turned_ / full_turn; }  ///< [turns]
    [[nodiscard]] bool is_stripped() const noexcept { return is_stripped_; }
    [[nodiscard]] bool is_finite() const noexcept { return is_finite_; }
    [[nodiscard]] int alternations() const { return max_turns(trace_.force, trace_.period); }
    /// [m] of the thread in bone.
    [[nodiscard]] double slip() const {
        return signal_of(loop_.simulation().setup(), loop_.simulation().signals(), "slip");
    }
    [[nodiscard]] double tip() const { return loop_.tip(); }

private:
    Port& port_;
    KerfLoop& loop_;
    Trace trace_{};
    double turned_ = 0.0, torque_ = 0.0;
    bool is_stripped_ = false, is_finite_ = true;
};

struct Screwed {
    double advance = 0.0, slip = 0.0;  ///< [m] in two turns before half way; of the bone until then
    int turning_alternates = 0;
    Judged held;
    double torque_in = 0.0, torque_out = 0.0;       ///< [N·m] as it turned in, and out
    double torque_rested = 0.0, torque_held = 0.0;  ///< [N·m] after a fifth of a second of rest, and at its end
    double back = 0.0;                              ///< [m] out in the turns back
    int backing_alternates = 0;
    double max_torque = 0.0, last_torque = 0.0, stripped_after = 0.0;  ///< [N·m], [turns] of the driver
    int stripping_alternates = 0;
    bool is_stripped = false, is_finite = true;
};

Screwed screw_in(const Body& body, const ToolUnderTest& screw, const PortSettings& settings, const CouplingGains& gains,
                 double push, KerfLoop::Rendering rendering) {
    Port port(settings, above);
    port.go_along(true);
    KerfLoop loop(body, screw.setup, gains, above, rendering, 0.0, settings.period);
    Driver driver(port, loop);
    Screwed seen;
    driver.turn(half_in - 2.0, push);
    driver.begin();
    const double before = driver.tip();
    driver.turn(2.0, push);
    seen.advance = driver.tip() - before;
    seen.slip = driver.slip();
    seen.torque_in = driver.torque();
    seen.turning_alternates = driver.alternations();

    driver.begin();
    port.aim_here();
    port.go_along(false);
    for (int i = 0; i < held_ticks; ++i) {
        driver.tick(0.0, push);
        if (i == cut_ends_after) seen.torque_rested = driver.torque();
    }
    seen.held = judge(driver.trace(), settings.resolution, false);
    seen.torque_held = driver.torque();

    port.go_along(true);
    driver.begin();
    driver.turn(-0.5, 0.0);  // the driver unwinds first
    const double inside = driver.tip();
    driver.turn(-backed_off, 0.0);
    seen.back = inside - driver.tip();
    seen.torque_out = driver.torque();
    seen.backing_alternates = driver.alternations();

    driver.begin();
    double after = 0.0;
    while (driver.turned() < max_turned && after < 1.0) {
        driver.tick(turning, push);
        if (driver.is_stripped()) {
            if (seen.stripped_after == 0.0) seen.stripped_after = driver.turned();
            after = driver.turned() - seen.stripped_after;
        }
        seen.max_torque = worst(seen.max_torque, driver.torque());
    }
    seen.last_torque = driver.torque();
    seen.stripping_alternates = driver.alternations();
    seen.is_stripped = driver.is_stripped();
    seen.is_finite = driver.is_finite();
    return seen;
}

std::string turns_back(int turns) { return std::to_string(turns) + " turns in 100 ms"; }

void tell(Finding finding, const Screwed& seen, double lead, const Report& report) {
    const auto add = [&](const char* scene, const std::string& measured, const char* criterion, bool is_good) {
        finding.scene = scene;
        finding.measured = measured;
        finding.criterion = criterion;
        finding.outcome = passes(is_good && seen.is_finite);
        report(finding);
    };
    const double along = seen.advance / (2.0 * lead), back = seen.back / (backed_off * lead);
    add("screw turned in",
        figure(100.0 * along, "%") + " of the lead, slip " + figure(1e3 * seen.slip, "mm") + ", " +
            turns_back(seen.turning_alternates),
        "lead within 2 %, slip < 0.1 mm, <=10 turns in 100 ms",
        std::abs(along - 1.0) <= 0.02 && seen.slip < max_slip && seen.turning_alternates <= 10);
    add("screw held half way",
        in_figures(seen.held) + ", torque " + figure(seen.torque_in, "N m") + ", after 0.2 s " +
            figure(seen.torque_rested, "N m") + ", after 1 s " + figure(seen.torque_held, "N m"),
        "<3 counts p-p after 0.5 s, <=10 turns in 100 ms, >=-0.1 mJ; torque from 0.2 s on within 2 %",
        seen.held.is_stable() && seen.torque_rested > 0.0 &&
            std::abs(seen.torque_held - seen.torque_rested) <= 0.02 * seen.torque_rested);
    add("screw backed off by two turns",
        figure(100.0 * back, "%") + " of the lead, torque " + figure(seen.torque_out, "N m") + ", " +
            turns_back(seen.backing_alternates),
        "lead within 2 %, torque the other way and smaller than in, <=10 turns in 100 ms",
        std::abs(back - 1.0) <= 0.02 && seen.torque_out < 0.0 && -seen.torque_out < seen.torque_in &&
            seen.backing_alternates <= 10);
    add("screw turned on until it strips",
        (seen.is_stripped ? "stripped after " + figure(seen.stripped_after) + " turns, "
                          : std::string("not stripped, ")) +
            figure(seen.max_torque, "N m") + ", then " + figure(seen.last_torque, "N m") + ", " +
            turns_back(seen.stripping_alternates),
        "strips, then less than half the torque; <=10 turns in 100 ms",
        seen.is_stripped && seen.last_torque < 0.5 * seen.max_torque && seen.stripping_alternates <= 10);
}

/// Returns the torque [N·m] of a screw that a hand turns in, every twentieth of a millimetre of its tip's path. The
/// hand goes along with the screw, half a millimetre ahead of it, so that its push is the same at every period.
std::vector<double> torques(const Body& body, const ToolUnderTest& screw, const CouplingGains& gains, double period) {
    constexpr double from = 4e-3, distance = 0.05e-3, ahead = 0.5e-3;  // [m]
    constexpr std::size_t samples = 200;
    KerfLoop loop(body, screw.setup, gains, above, KerfLoop::Rendering::solved, 0.0, period);
    std::vector<double> torque;
    for (double turned = 0.0; torque.size() < samples && turned < max_turned * full_turn; turned += turning * period) {
        loop.turn(turning * period);
        (void)loop.answer(loop.tip() + ahead);
        if (loop.tip() >= from + distance * static_cast<double>(torque.size())) torque.push_back(loop.last().torque);
    }
    return torque;
}

void check_ticks(const DeviceRecord& device, const Body& body, const ToolUnderTest& screw, const Report& report) {
    const CouplingGains gains = in_hands(gains_for(device, std::min(1.0, push_of(device) / work_push)));
    const std::vector<double> usual = torques(body, screw, gains, Simulation::dt);
    const double largest = usual.empty() ? 0.0 : *std::max_element(usual.begin(), usual.end());
    for (const double period : {2e-3, 0.5e-3, 0.25e-3}) {
        const std::vector<double> other = torques(body, screw, gains, period);
        double off = 0.0;
        for (std::size_t i = 0; i < std::min(usual.size(), other.size()); ++i)
            off = worst(off, std::abs(other[i] - usual[i]));
        Finding finding{.test = "S-20", .scene = "screw turned in, loop at " + figure(1.0 / period, "Hz"), .hand = led};
        finding.device = device.id;
        finding.measured = "torque differs by " + figure(100.0 * off / largest, "%");
        finding.criterion = "<= 2 % of the largest at 1000 Hz";
        finding.outcome = passes(off <= 0.02 * largest && other.size() == usual.size() && !usual.empty());
        report(finding);
    }
}

}  // namespace

void check_screw(const Scope& scope, const ToolUnderTest& screw, const Report& report) {
    const auto core = tool_parameter(screw.setup, "tip_core_diameter");
    const Body body = pilot_block(core ? 0.5 * screw.setup.tool_parameters[*core] : screw.radius);
    for (const DeviceRecord& device : scope.devices) check_ticks(device, body, screw, report);
    at_every_port(scope, [&](const DeviceRecord& device, const PortSettings& settings) {
        const double push = push_of(device);
        const CouplingGains gains = in_hands(gains_for(device, std::min(1.0, push / work_push), settings.delay));
        for (const auto rendering : {KerfLoop::Rendering::direct, KerfLoop::Rendering::solved}) {
            Finding finding{.test = "S-20"};
            finding.method = rendering == KerfLoop::Rendering::solved ? Method::kerf : Method::as_printed;
            finding.device = device.id;
            finding.hand = settings.hand.id;
            finding.delay = settings.delay;
            tell(finding, screw_in(body, screw, settings, gains, push, rendering), screw.lead, report);
        }
    });
}

}  // namespace kerf::stability
