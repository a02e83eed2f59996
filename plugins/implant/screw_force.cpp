// SPDX-License-Identifier: Apache-2.0
#include "screw_force.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace kerf::implant {

namespace {

using namespace literals;
using Happened = ScrewInsertion::Happened;

constexpr std::uint32_t id_helix = 0, id_flanks = 1, id_flutes = 2, id_head = 3, id_blocked = 4;
constexpr std::uint32_t id_offset_x = 5, id_offset_y = 6, id_inclination_x = 7, id_inclination_y = 8;
constexpr double creep = 1e-6;          // [m/s] below which friction is a stiff damper, so that a screw at rest stays
constexpr double cut_onset = 1e-4;      // [m/s]
constexpr double crush_onset = 1e-5;    // [m/s]
constexpr double seated_force = 5.0;    // [N] under the head from which on it counts as seated [judgement]
constexpr double first_slip = 0.02_mm;  // [m] slip from which on a thread yields [judgement]
constexpr double much_slip = 1.0_mm;    // [m] slip that an operation reports [judgement]
constexpr double stripped_at = 0.3;     // [–] of its strength; below it a thread counts as stripped
constexpr double bitten = 0.05;         // [rad] turn in bone after which a crest has begun its groove [judgement]
constexpr double turned_back = 0.3;     // [rad] behind the farthest turn, from which on a screw backs out
constexpr double min_engaged_turns =
    2.0;                              // [–] turns of thread in bone from which on it can yield or strip [judgement]
constexpr double left_bone = 0.2_mm;  // [m] travel without bone after which a thread has left it [judgement]
constexpr double catching_up = 2.0;   // [–] rate, relative to the helix, of crests that were pushed in
constexpr double flute_scale = 10.0_mm;
constexpr double tilt_arm = 10.0_mm;    // [m] lever of a channel that turns
constexpr double same_width = 0.05_mm;  // [m] a groove narrower by no more than this needs no cutting

/// Unit motion along the thread at its mean radius, as a rate of the tool.
struct Slide {
    Vec6 d{};
    double radius;  ///< [m]
    double length;  ///< [m] along the thread for one radian

    explicit Slide(const ScrewThread& thread) noexcept
        : radius(thread.mean_radius(-0.5 * thread.length)),
          length(std::sqrt(radius * radius + thread.advance() * thread.advance())) {
        d[2] = thread.advance() / length;
        d[5] = radius * radius / length;
    }
};

Vec6 helix_of(const ScrewThread& thread) noexcept { return {0, 0, 1, 0, 0, -thread.advance()}; }

/// Returns the fraction of the pressure that remains where flutes have cut bone away [–].
double pressure_fraction(const ScrewThread& thread, double relief) noexcept {
    return 1.0 - relief * (1.0 - exp_exact(-thread.flutes * thread.flute_length / flute_scale));
}

/// Returns the fraction of the groove still to be cut at `z` of the tool, after a narrower tap [–].
double fraction_to_cut(const ThreadTrack& track, const ScrewThread& thread, double z) noexcept {
    const double front = track.depth_of({0, 0, z});
    const double tapped = track.fraction_tapped(front, 0.5 * thread.outer_at(z), 0.5 * thread.core_at(z));
    return 1.0 - tapped * tapped;
}

/// Returns the distance along the shaft [m] of the leading crest, at `z` of the tool, from bone that it has not cut; 0
/// at the front.
double distance_to_front(const ThreadTrack& track, const ScrewThread& thread, double z) noexcept {
    if (!track.is_there()) return 0.0;
    const double front = track.depth_of({0, 0, z});
    const kerf_thread& groove = track.thread();
    const bool is_tapped = groove.tapped_radius >= 0.5 * thread.outer - same_width;
    return std::max(0.0, (is_tapped ? std::max(groove.to, groove.tapped_to) : groove.to) - front);
}

}  // namespace

void ScrewInsertion::begin(const HeldThread& tool, const BoneQuery&, State& state) const noexcept {
    Prepared& p = state.prepared;
    p.thread = tool.as<ThreadedTool>().thread();
    p.thread_points = ThreadPoints(p.thread);
    p.contact = ScrewContact(p.thread);
}

/// Adds channels that keep the tool on the thread's axis.
void ScrewInsertion::add_track(const ThreadTrack& track, const BoneThread& found, Channels& channels) const noexcept {
    if (!track.is_there() || found.stiffness <= 0.0) return;
    const Vec3 offset = track.offset(found.middle), inclination = track.inclination();
    const double stiffness = found.left * found.stiffness, limit = found.left * found.pressed;
    if (stiffness <= 0.0 || limit <= 0.0) return;
    const auto hold = [&](std::uint32_t id, const Vec6& d, double k, double stretch, double largest) {
        channels.hold({.id = id, .d = d, .stiffness = k, .stretch = stretch, .limit = largest});
    };
    hold(id_offset_x, {1, 0, 0, 0, found.middle, 0}, stiffness, offset.x, limit);
    hold(id_offset_y, {0, 1, 0, -found.middle, 0, 0}, stiffness, offset.y, limit);
    const double spread = found.spread / tilt_arm;
    if (spread <= 0.0) return;
    hold(id_inclination_x, {0, 0, 0, tilt_arm, 0, 0}, stiffness * spread * spread, tilt_arm * inclination.x,
         limit * spread);
    hold(id_inclination_y, {0, 0, 0, 0, tilt_arm, 0}, stiffness * spread * spread, tilt_arm * inclination.y,
         limit * spread);
}

ScrewInsertion::Notes ScrewInsertion::resist(const HeldThread&, const BoneQuery& bone, const State& state,
                                             Channels& channels) const noexcept {
    const auto& [thread, thread_points, contact] = state.prepared;
    const ThreadTrack track = ThreadTrack::found(bone, thread, state.held);
    const BoneThread found(thread_points, thread, track, state.hole, *this, bone);
    const auto less = [](double x) { return static_cast<float>(x); };
    const Notes notes{.strength = found.strength,
                      .stiffness = found.stiffness,
                      .engaged = found.engaged,
                      .left = less(found.left),
                      .front = less(found.front_in_bone),
                      .lost = less(found.lost),
                      .bite = less(found.bite),
                      .middle = less(found.middle),
                      .across = less(found.left * found.pressed),
                      .spread = less(found.spread),
                      .leading = less(found.leading),
                      .last = less(found.last),
                      .body = found.body};
    const Slide slide(thread);

    if (found.strength > 0.0)
        channels.hold({.id = id_helix,
                       .d = helix_of(thread),
                       .stiffness = found.stiffness,
                       .stretch = state.stretch,
                       .limit = found.strength});
    const SinCos flank = sin_cos_exact(thread.flank_angle);
    const double pressed = found.left * pressure_fraction(thread, flute_relief) * found.rubbing / slide.radius,
                 carried = std::min(std::abs(state.grip_force), found.strength);
    if (const double limit = pressed + friction * carried / flank.cos; limit > 0.0)
        if (kerf_channel* c = channels.add(KERF_FRICTION, id_flanks, slide.d)) {
            c->tau = limit;
            c->w = creep;
        }
    const double front = track.depth_of({0, 0, thread.first_crest()});
    if (const double cut = fraction_to_cut(track, thread, front); thread.flutes > 0.0 && found.front > 0.0 && cut > 0.0)
        if (kerf_channel* c = channels.add(KERF_CUT, id_flutes, slide.d)) {
            c->tau = found.left * cut * chip * thread.groove_area(found.leading) * found.front;
            c->w = cut_onset;
            c->gap = distance_to_front(track, thread, found.leading) / thread.advance() * slide.length;
        }
    if (found.blocked > 0.0)
        channels.cut(
            {.id = id_blocked, .along = {0, 0, 1}, .edge_force = found.blocked, .onset = crush_onset, .slope = 0.0});
    add_track(track, found, channels);
    contact.add_to(channels, *this, bone);
    if (state.seat_force > 0.0 && head_friction > 0.0)
        if (kerf_channel* c =
                channels.add(KERF_FRICTION, id_head, Vec6{0, 0, 0, 0, 0, 0.25 * (thread.outer + thread.head)})) {
            c->tau = head_friction * state.seat_force;
            c->w = creep;
        }
    return notes;
}

void ScrewInsertion::turn_in(const Noted<Notes>& advance, double dt, ThreadTrack& track, State& state) const noexcept {
    const ScrewThread& thread = state.prepared.thread;
    const Notes& notes = advance.notes;
    const double along = advance.rate[2] * dt, turn = advance.rate[5] * dt;
    kerf_thread& groove = track.thread();
    const double leading = static_cast<double>(notes.leading), front = track.depth_of({0, 0, leading}) + along;

    state.stretch += along - thread.advance() * turn;
    const double slip = yield_plastically(state.stretch, notes.stiffness, notes.strength);
    state.is_slipping = slip > 0.0;
    // Crests that are in bone by a part of their depth shear only that part.
    track.add_slip(track.depth_of({0, 0, static_cast<double>(notes.last)}), front,
                   static_cast<double>(notes.bite) * slip);

    if (groove.radius < 0.5 * thread.outer - same_width) {  // it widens the thread of a tap
        groove.radius = 0.5 * thread.outer;
        groove.to = std::max(groove.from, front - along);
    }
    // Crests that were pushed in cut their whole helix within one turn.
    if (const double last = track.depth_of({0, 0, static_cast<double>(notes.last)}); turn > 0.0 && last < groove.from)
        groove.from = std::max(last, groove.from - turn / (2.0 * pi) * thread.length);
    if (turn > 0.0 && front > groove.to) {
        const double to = std::min(front, groove.to + catching_up * thread.advance() * turn);
        groove.volume += fraction_to_cut(track, thread, leading) * static_cast<double>(notes.front) *
                         thread.groove_volume(leading) * (to - groove.to);
        groove.to = to;
    }
    if (thread.takes_chips_out) {
        const double radius = 0.5 * thread.outer;
        if (radius > groove.tapped_radius + same_width) {  // it widens a narrower groove, up to its own depth
            groove.tapped_radius = radius;
            groove.tapped_to = groove.from;
        }
        if (radius > groove.tapped_radius - same_width) groove.tapped_to = std::max(groove.tapped_to, front);
    }

    if (front < groove.tapped_to) return;  // the thread ahead keeps its axis
    const double stiffness = static_cast<double>(notes.left) * notes.stiffness,
                 spread = static_cast<double>(notes.spread), middle = static_cast<double>(notes.middle),
                 across = static_cast<double>(notes.across);
    const Vec3 offset = track.offset(middle), inclination = track.inclination();
    Vec3 held = offset, turned = inclination;
    static_cast<void>(yield_plastically(held.x, stiffness, across));
    static_cast<void>(yield_plastically(held.y, stiffness, across));
    static_cast<void>(yield_plastically(turned.x, stiffness * spread * spread, across * spread));
    static_cast<void>(yield_plastically(turned.y, stiffness * spread * spread, across * spread));
    track.yield_plastically(offset - held, inclination - turned, middle);
}

void ScrewInsertion::report(const Notes& notes, State& state, Actions& actions) const noexcept {
    Reported& reported = state.reported;
    const auto once = [&](bool& was, bool is, Happened which) {
        if (is && !std::exchange(was, true)) actions.event(which);
    };
    once(reported.is_in, state.angle > bitten, Happened::going_in);
    once(reported.has_seated, state.seat_force > seated_force, Happened::head_contact);
    // Crests that were pushed through during insertion do not strip a thread. Neither does a tool that leaves through
    // them.
    const bool is_engaged = notes.engaged > min_engaged_turns * state.prepared.thread.lead();
    const auto lost = static_cast<double>(notes.lost);
    once(reported.has_yielded, is_engaged && state.is_slipping && lost > first_slip, Happened::yield);
    once(reported.has_slipped, is_engaged && lost > much_slip, Happened::slipped);
    once(reported.is_stripped,
         is_engaged && state.is_slipping && lost > yield_slip && static_cast<double>(notes.left) < stripped_at,
         Happened::stripped);
    const bool is_back = state.angle < state.front - turned_back;
    once(reported.is_backing_out, is_back && !reported.is_stripped, Happened::backing_out);
    if (is_back && state.seat_force <= 0.0) reported.has_seated = false;  // it may seat again
    if (!is_back) reported.is_backing_out = false;
    if (state.away <= left_bone) return;
    state.angle = state.front = state.pushed = 0.0;
    state.held = KERF_NEW_THREAD;
    reported = {};
}

void ScrewInsertion::commit(const HeldThread& tool, const BoneQuery& bone, const Noted<Notes>& advance, State& state,
                            Signals& signals, Actions& actions) const noexcept {
    const double dt = tool.tick.dt, turn = advance.rate[5] * dt;
    const ScrewThread& thread = state.prepared.thread;
    const Notes& notes = advance.notes;

    state.hole.measure(thread, bone, advance.rate[2] * dt);
    state.is_slipping = false;
    state.torque = 0.0;
    for (std::size_t c = 0; c < advance.channel.size(); ++c)
        state.torque += advance.channel[c].d[5] * advance.lambda[c];
    state.grip_force = advance.force_of_channel(id_helix);
    state.seat_force = std::max(0.0, advance.force_of_channel(ScrewContact::id_seat));
    const bool is_blocked = advance.force_of_channel(id_blocked) != 0.0;
    if (is_blocked) state.pushed += std::max(0.0, advance.rate[2] * dt - thread.advance() * std::max(0.0, turn));
    // By then the next crest has reached the first one's position, so no bone is left between them.
    const bool is_broached = is_blocked && state.pushed > thread.pitch;
    if (notes.engaged > 0.0) {
        state.away = 0.0;
        state.angle += turn;
        state.front = std::max(state.front, state.angle);
        ThreadTrack track = ThreadTrack::found(bone, thread, state.held);
        if (track.is_crossed() && !std::exchange(state.reported.is_crossed, true))
            actions.event(Happened::cross_threaded);
        if (!track.is_there()) state.angle = state.front = std::max(0.0, state.angle);
        if (!track.is_there() && turn > 0.0 && state.angle > bitten)
            track = ThreadTrack::begun(thread, static_cast<double>(notes.leading), notes.body);
        if (track.is_there()) {
            state.held = track.thread().number;
            turn_in(advance, dt, track, state);
            if (state.reported.is_stripped && notes.left <= 0.0f && !std::exchange(state.reported.is_cut, true))
                actions.cut_thread();
            actions.leave(track.thread());
        } else {
            state.stretch = 0.0;
        }
    } else {
        state.stretch = 0.0;
        state.away += std::abs(advance.rate[2]) * dt;
    }
    report(notes, state, actions);

    bool meets_bone = notes.engaged > 0.0;
    for (const kerf_channel& channel : advance.channel) meets_bone = meets_bone || channel.id == ScrewContact::id_tip;
    if (is_broached) actions.cut_thread();
    if (meets_bone) actions.cut();  // removes bone inside the core's outline; bone between the crests stays
    signals = {.torque = state.torque,
               .turned = state.angle,
               .engaged = notes.engaged,
               .clamp = state.seat_force,
               .slip = static_cast<double>(notes.lost),
               .pull_out = notes.strength};
}

}  // namespace kerf::implant
