// SPDX-License-Identifier: Apache-2.0
#include "drill_force.h"

#include <algorithm>
#include <cmath>

namespace kerf::drilling {

namespace {

using namespace literals;
using Happened = DrillCutting::Happened;

// Contact adds stress for a tick or two as a drill breaks through, which bends no bit [judgement].
constexpr double bending_time = 20.0_ms;
// `bit_overbent` fires once and re-arms below this fraction of the yield stress: lips that graze a wall bend the bit
// twice a turn [judgement].
constexpr double straight_again = 0.05;  // [–]

constexpr PhaseEvents<Happened> phase_events{.off = Happened::spindle_off,
                                             .speeding_up = Happened::spinning_up,
                                             .running = Happened::running,
                                             .reversing = Happened::reversing,
                                             .bogging = Happened::bogging,
                                             .stalled = Happened::stalled,
                                             .running_down = Happened::running_down};

Turning turning_of(const DrillCutting::State& state, double dt) noexcept {
    const double speed = state.cutter.speed(), n = std::max(speed, slowest_cut);
    return {.n = n, .cutting = state.cutter.cutting, .speed = std::abs(speed), .turns = dt * n};
}

/// Returns the torque [N·m] on a drill under `push` [N] that removes no bone. To start, its edges must break loose. The
/// torque is the one that cutting at this thrust would take. In reverse the edges rub.
double breakaway_torque(Edges& edges, const DrillParameters& law, double push, bool is_reverse) noexcept {
    if (is_reverse) return law.friction * push * 2.0 / 3.0 * edges.drill.radius();
    constexpr double n = 1.0, built_up = 10.0;  // in edge depths; beyond it, force grows linearly with the chip
    const double edge_depth = law.edge_depth;
    const auto at = [&](double chip) {
        const double feed_rate = lip_count * n * chip;
        edges.divide_feed({feed_rate, {}}, n, edges.min_gap(), edge_depth);
        return edge_forces(edges, law, n, feed_rate);
    };
    const EdgeForces thin = at(built_up * edge_depth);
    if (thin.thrust() <= 0.0) return 0.0;
    if (push <= thin.thrust()) return push * thin.torque() / thin.thrust();
    const EdgeForces thick = at(2.0 * built_up * edge_depth);
    return thin.torque() + (push - thin.thrust()) * (thick.torque() - thin.torque()) / (thick.thrust() - thin.thrust());
}

/// Decides whether the still tip crushes bone or rests on it from the next tick on, and whether a wall breaks.
void crush_or_rest(double dt, const BoneQuery& bone, const Noted<DrillCutting::Notes>& advance,
                   DrillCutting::State& state, Actions& actions) noexcept {
    const DrillCutting::Notes& notes = advance.notes;
    const TipLoad tip_load(advance);
    const bool breaks = state.crushes && notes.breaks_on != PressedWall::no_ray && is_crushed(advance),
               is_in_broken = state.crushes && notes.is_broken;
    if (breaks && state.broken.break_out(state.wall.on(notes.breaks_on))) actions.event(Happened::wall_broken);
    state.broken.move_with_tip(advance.rate, dt, breaks || is_in_broken);
    if (state.crushes || tip_load.force > 0.0 || state.broken.is_there())
        state.prepared.tip.sample_side(state.wall, bone);
    else
        state.wall.forget();
    if (state.crushes) {
        state.crushes = breaks || is_in_broken || continues_crushing(advance, state.crushing_from);
    } else if (state.prepared.tip.begins(tip_load, state.wall, state.broken, bone)) {
        state.crushes = true;
        state.crushing_from = tip_load.force;
        if (!state.broken.is_there()) actions.event(Happened::crushing);
    }
}

}  // namespace

void DrillCutting::begin(const AnyDrill& tool, const BoneQuery& bone, State& state) const noexcept {
    Prepared& p = state.prepared;
    p.drill = tool.visit([](const auto& bit) { return bit.drill(); });
    p.edges = {p.drill, *this, bone};
    p.sides = {p.drill, *this, bone};
    p.touching_in_cut = touching_points(p.drill, *this, bone, true);
    p.touching = touching_points(p.drill, *this, bone, false);
    p.tip = {p.drill, *this, bone};
    state.broken = BrokenWall(0.5 * p.drill.widest_radius());
    p.bending_weight = 1.0 - exp_exact(-tool.tick.dt / bending_time);
}

DrillCutting::Notes DrillCutting::resist(const AnyDrill& tool, const BoneQuery& bone, const State& state,
                                         Channels& channels) const noexcept {
    const Turning turning = turning_of(state, tool.tick.dt);
    const auto& [drill, edge_layout, sides, touching_in_cut, touching, tip, bending_weight] = state.prepared;
    Notes notes;
    if (turning.cutting.resists()) {
        Edges edges(drill, edge_layout, *this, bone, state.angle);
        notes.engagement = edges.engagement();
        add_feed_cutting(edges, *this, turning, state.travel, channels);
        if (turning.cutting.removes_bone())
            add_side_cutting(sides, *this, bone, turning, state.travel, state.holes, channels);
    }
    if (state.crushes) {
        const CrushingTip::PressedWalls met = tip.add_to(channels, state.wall, state.broken, bone);
        notes.breaks_on = met.breaks_on;
        notes.is_broken = met.is_broken;
    }
    const bool goes_in = turning.cutting.removes_bone() || state.crushes;
    notes.is_bent = add_contact(drill, goes_in ? touching_in_cut : touching, *this, bone, turning, state.hole,
                                state.carried, channels);
    channels.push({}, {0, 0, -state.reaction});
    return notes;
}

void DrillCutting::commit(const AnyDrill& tool, const BoneQuery& bone, const Noted<Notes>& advance, State& state,
                          Signals& signals, Actions& actions) const noexcept {
    const DrillBit& bit = tool.as<DrillBit>();
    const double dt = tool.tick.dt;
    const Turning turning = turning_of(state, dt);
    const TwistDrill& drill = state.prepared.drill;
    state.travel.advance(advance.rate, dt, turning.n);
    state.carried = Carried(advance);
    if (!advance.has_law || advance.notes.is_bent)
        state.hole.move(advance.rate, dt);
    else
        state.hole = {};

    // Signals and the motor's load: the torque that follows the channels. A drill that removes no bone samples its
    // edges again.
    const bool removes_bone = turning.cutting.removes_bone();
    double engaged = advance.notes.engagement;
    double load = friction * state.carried.by_shank * drill.shank_radius(), feed_thrust = 0.0;
    for (std::size_t c = 0; c < advance.channel.size(); ++c) {
        const std::uint32_t id = advance.channel[c].id;
        if (id == id_feed) feed_thrust = advance.lambda[c];
        const bool is_edge = id == id_feed || (id >= id_side && id < id_side + SideEdges::directions);
        if (removes_bone && is_edge) load -= advance.channel[c].follow[5] * advance.lambda[c];
    }
    if (!removes_bone) {
        Edges edges(drill, state.prepared.edges, *this, bone, state.angle);
        engaged = edges.engagement();
        load += breakaway_torque(edges, *this, advance.axial_thrust(), state.cutter.speed() < 0.0);
    }
    const bool is_cutting = removes_bone && feed_thrust > 0.0;
    const double front = is_cutting      ? state.travel.feed_rate
                         : state.crushes ? std::max(0.0, advance.rate[2])
                                         : 0.0;  // [m/s]
    state.prepared.sides.move_in_holes(advance.rate, dt, front * dt, state.holes);
    const double feed = state.travel.feed_rate / turning.n;
    signals.feed_per_revolution = is_cutting ? feed : 0.0;
    signals.chip_thickness = is_cutting ? feed / lip_count * drill.half_point.sin : 0.0;
    signals.engagement = engaged;
    signals.drive_power = 2.0 * pi * turning.speed * load;
    signals.spindle_speed = state.cutter.speed();
    const Bending bending = bending_of(drill, advance);
    state.bending.about_x += state.prepared.bending_weight * (bending.about_x - state.bending.about_x);
    state.bending.about_y += state.prepared.bending_weight * (bending.about_y - state.bending.about_y);
    signals.bending_stress = state.bending.stress();
    const bool is_overbent = signals.bending_stress > (state.is_overbent ? straight_again : 1.0) * bit.yield_strength;
    if (is_overbent && !state.is_overbent) actions.event(Happened::bit_overbent);
    state.is_overbent = is_overbent;

    if (removes_bone || state.crushes) actions.cut();
    state.angle += 2.0 * pi * state.cutter.speed() * dt;
    state.angle -= state.angle >= 2.0 * pi ? 2.0 * pi : state.angle < 0.0 ? -2.0 * pi : 0.0;
    state.cutter.step(bit.motor(), bit.spindle_speed, load, dt, slowest_cut, phase_events, actions);
    // While the drill cuts, the channels' `follow` contains the bone's torque, so the reaction is only the motor's
    // excess. Otherwise it is the motor's whole torque.
    const Spindle& motor = state.cutter.motor;
    const bool cuts = motor.speed >= slowest_cut;  // in reverse the edges rub
    const double sense = motor.speed != 0.0 ? motor.speed : bit.spindle_speed;
    state.reaction = std::copysign(1.0, sense) * (cuts ? motor.excess_torque(load) : motor.torque);
    if (cuts) {
        state.crushes = false;
        state.wall.forget();
        state.broken = BrokenWall(state.broken.within());
    } else {
        crush_or_rest(dt, bone, advance, state, actions);
    }
}

}  // namespace kerf::drilling
