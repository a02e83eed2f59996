// SPDX-License-Identifier: Apache-2.0
#include "drill_force.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace kerf::drilling {

namespace {

using namespace literals;

// Below `slowest_cut` its edges only drag, less and less, while it sinks onto the bone that they leave standing; so
// contact takes over without a blow.
constexpr double dragging_time = 2.0_ms;
// What contact adds for a tick or two as a drill breaks through bends no bit [judgement].
constexpr double bending_time = 5.0_ms;
// That it is bent too far is told once, until it is hardly bent any more: lips that graze a wall bend it twice a turn.
constexpr double straight_again = 0.05;  // [–] of what it stands [judgement]

// Share of the edges in bone; whether the shank does not fit into its hole; a way to what breaks out before a still
// tip, and one; whether something has.
enum Note : std::size_t { note_engagement, note_is_bent, note_breaks_on, note_is_broken };

Turning turning_of(const DrillCutting::State& state) noexcept {
    return {std::max(state.spindle.speed, slowest_cut), state.cut_share, std::abs(state.spindle.speed)};
}

Event event_of(Spindle::Phase phase) noexcept {
    switch (phase) {
        case Spindle::Phase::off:
            return event_spindle_off;
        case Spindle::Phase::spinning_up:
            return event_spinning_up;
        case Spindle::Phase::running:
            return event_running;
        case Spindle::Phase::reversing:
            return event_reversing;
        case Spindle::Phase::stalled:
            return event_stalled;
        case Spindle::Phase::bogging:
            return event_bogging;
        case Spindle::Phase::running_down:
            return event_running_down;
    }
    return event_spindle_off;
}

/// What pushes the drill back along its shaft, of all channels [N].
double pushed_along(const Advance& advance) noexcept {
    double sum = 0.0;
    for (std::size_t c = 0; c < advance.channel.size(); ++c)
        if (advance.channel[c].kind != KERF_FRICTION) sum += advance.channel[c].d[2] * advance.lambda[c];
    return std::max(0.0, sum);
}

/// Torque that a drill under `push` [N] meets while it takes no bone: to start, its edges have to break loose what they
/// stand in, with the torque that goes with such a push in cutting; in reverse they rub.
double torque_of_standing(Edges& edges, const Tick& tick, double push, bool is_reverse) noexcept {
    if (is_reverse) return tick.force[force_friction] * push * 2.0 / 3.0 * edges.drill.radius();
    constexpr double n = 1.0, built_up = 10.0;  // edge depths: from there on force grows evenly with the chip
    const double edge_depth = tick.force[force_edge_depth];
    const auto at = [&](double chip) {
        const double feed_rate = lip_count * n * chip;
        edges.share_out({feed_rate, {}}, n, edges.least_gap(), edge_depth);
        return edge_forces(edges, tick, n, feed_rate);
    };
    const EdgeForces thin = at(built_up * edge_depth);
    if (thin.thrust() <= 0.0) return 0.0;
    if (push <= thin.thrust()) return push * thin.torque() / thin.thrust();
    const EdgeForces thick = at(2.0 * built_up * edge_depth);
    return thin.torque() + (push - thin.thrust()) * (thick.torque() - thin.torque()) / (thick.thrust() - thin.thrust());
}

/// Whether the tip, which does not turn, goes into bone or stands on it from the next tick on, and what breaks before
/// it.
void crush_or_stand(const Tick& tick, const BoneQuery& bone, const Advance& advance, DrillCutting::State& state,
                    Actions& actions) noexcept {
    const auto note = [&](Note which) { return advance.note.empty() ? 0.0 : advance.note[which]; };
    const Standing standing(advance);
    const bool breaks = state.crushes && note(note_breaks_on) > 0.0 && is_crushed(advance),
               is_in_broken = state.crushes && note(note_is_broken) > 0.0;
    if (breaks && state.broken.break_out(state.wall.on(static_cast<std::size_t>(note(note_breaks_on)) - 1)))
        actions.event(event_wall_broken);
    state.broken.go(advance.rate, tick.dt, breaks || is_in_broken);
    if (state.crushes || standing.force > 0.0 || state.broken.is_there())
        state.prepared.tip.look(state.wall, bone);
    else
        state.wall.forget();
    if (state.crushes) {
        state.crushes = breaks || is_in_broken || goes_on_crushing(advance, state.crushing_from);
    } else if (state.prepared.tip.begins(standing, state.wall, state.broken, bone)) {
        state.crushes = true;
        state.crushing_from = standing.force;
        if (!state.broken.is_there()) actions.event(event_crushing);
    }
}

}  // namespace

void DrillCutting::begin(const Tick& tick, const BoneQuery& bone, State& state) noexcept {
    Prepared& p = state.prepared;
    p.drill = drill_of(tick.tool);
    p.edges = {p.drill, tick, bone};
    p.sides = {p.drill, tick, bone};
    p.touching_in_cut = touching_points(p.drill, tick, bone, true);
    p.touching = touching_points(p.drill, tick, bone, false);
    p.tip = {p.drill, tick, bone};
    state.broken = BrokenWall(0.5 * p.drill.widest_radius());
    p.bending_share = 1.0 - exp_exact(-tick.dt / bending_time);
}

void DrillCutting::resist(const Tick& tick, const BoneQuery& bone, const State& state, Channels& channels) noexcept {
    const Turning turning = turning_of(state);
    const auto& [drill, edge_places, sides, touching_in_cut, touching, tip, bending_share] = state.prepared;
    if (turning.drags()) {
        Edges edges(drill, edge_places, tick, bone, state.angle);
        channels.note(note_engagement, edges.engagement());
        add_feed_cutting(edges, tick, turning, state.travel, channels);
        if (turning.removes()) add_side_cutting(sides, tick, bone, turning, state.travel, state.holes, channels);
    }
    if (state.crushes) {
        const CrushingTip::Met met = tip.add_to(channels, state.wall, state.broken, bone);
        channels.note(note_breaks_on,
                      met.breaks_on == PressedWall::no_way ? 0.0 : static_cast<double>(met.breaks_on + 1));
        channels.note(note_is_broken, met.is_broken ? 1.0 : 0.0);
    }
    const bool is_bent = add_contact(drill, turning.removes() || state.crushes ? touching_in_cut : touching, tick, bone,
                                     turning, state.hole, state.carried, channels);
    channels.note(note_is_bent, is_bent ? 1.0 : 0.0);
    channels.push({}, {0, 0, -state.reaction});
}

void DrillCutting::commit(const Tick& tick, const BoneQuery& bone, const Advance& advance, State& state,
                          std::span<double> signals, Actions& actions) noexcept {
    const Turning turning = turning_of(state);
    const TwistDrill& drill = state.prepared.drill;
    state.travel.advance(advance.rate, tick.dt, turning.n);
    state.carried = Carried(advance);
    if (advance.note.empty() || advance.note[note_is_bent] > 0.0)
        state.hole.move(advance.rate, tick.dt);
    else
        state.hole = {};

    // Signals and the motor's load: the torque that follows the channels. A drill that takes no bone asks its edges
    // again.
    double engaged = advance.note.empty() ? 0.0 : advance.note[note_engagement];
    double load = tick.force[force_friction] * state.carried.by_shank * drill.shank_radius(), feed_thrust = 0.0;
    for (std::size_t c = 0; c < advance.channel.size(); ++c) {
        if (advance.channel[c].id != id_feed) continue;
        feed_thrust = advance.lambda[c];
        if (turning.removes()) load -= advance.channel[c].follow[5] * feed_thrust;
    }
    if (!turning.removes()) {
        Edges edges(drill, state.prepared.edges, tick, bone, state.angle);
        engaged = edges.engagement();
        load += torque_of_standing(edges, tick, pushed_along(advance), state.spindle.speed < 0.0);
    }
    const bool is_cutting = turning.removes() && feed_thrust > 0.0;
    const double front = is_cutting      ? state.travel.feed_rate
                         : state.crushes ? std::max(0.0, advance.rate[2])
                                         : 0.0;  // [m/s]
    state.prepared.sides.move_in_holes(advance.rate, tick.dt, front * tick.dt, state.holes);
    const double feed = state.travel.feed_rate / turning.n;
    signals[signal_feed_per_revolution] = is_cutting ? feed : 0.0;
    signals[signal_chip_thickness] = is_cutting ? feed / lip_count * drill.half_point.sin : 0.0;
    signals[signal_engagement] = engaged;
    signals[signal_drive_power] = 2.0 * pi * turning.speed * load;
    signals[signal_spindle_speed] = state.spindle.speed;
    state.bending_stress += state.prepared.bending_share * (bending_stress(drill, advance) - state.bending_stress);
    signals[signal_bending_stress] = state.bending_stress;
    const bool is_overbent =
        state.bending_stress > (state.is_overbent ? straight_again : 1.0) * tick.tool[tool_yield_strength];
    if (is_overbent && !state.is_overbent) actions.event(event_bit_overbent);
    state.is_overbent = is_overbent;

    if (turning.removes() || state.crushes) actions.cut();
    state.angle += 2.0 * pi * state.spindle.speed * tick.dt;
    state.angle -= state.angle >= 2.0 * pi ? 2.0 * pi : state.angle < 0.0 ? -2.0 * pi : 0.0;
    if (state.spindle.step(motor_of(tick.tool), tick.drive[drive_spindle_speed], load, tick.dt))
        actions.event(event_of(state.spindle.phase));
    // While it cuts the bone's own torque follows the channels, and the rest of the motor's is felt besides; else all
    // of it.
    const bool cuts = state.spindle.speed >= slowest_cut;  // in reverse the edges rub
    const double sense = state.spindle.speed != 0.0 ? state.spindle.speed : tick.drive[drive_spindle_speed];
    state.reaction = std::copysign(1.0, sense) * (cuts ? state.spindle.reaction_beyond(load) : state.spindle.torque);
    if (cuts) {
        state.crushes = false;
        state.wall.forget();
        state.broken = BrokenWall(state.broken.within());
    } else {
        crush_or_stand(tick, bone, advance, state, actions);
    }
    state.cut_share = cuts ? 1.0 : state.cut_share > 1e-6 ? state.cut_share * exp_exact(-tick.dt / dragging_time) : 0.0;
}

}  // namespace kerf::drilling
