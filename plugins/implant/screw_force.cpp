// SPDX-License-Identifier: Apache-2.0
#include "screw_force.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace kerf::implant {

namespace {

using namespace literals;
using Happened = ScrewInsertion::Happened;
using Phase = ScrewInsertion::Phase;

constexpr std::uint32_t id_helix = 0, id_flanks = 1, id_flutes = 2, id_head = 3, id_blocked = 4;
constexpr std::uint32_t id_beside_x = 5, id_beside_y = 6, id_askew_x = 7, id_askew_y = 8;
constexpr double creep = 1e-6;          // [m/s] below which friction is a stiff damper: a screw at rest stays
constexpr double cut_onset = 1e-4;      // [m/s]
constexpr double crush_onset = 1e-5;    // [m/s]
constexpr double seated_force = 5.0;    // [N] under the head from which on it counts as seated [judgement]
constexpr double first_slip = 0.02_mm;  // from there on a thread yields [judgement]
constexpr double stripped_at = 0.3;     // [–] of its strength left, at which a thread counts as stripped
constexpr double bitten = 0.05;         // [rad] of a turn in bone after which a crest has begun its groove [judgement]
constexpr double turned_back = 0.3;     // [rad] behind the farthest turn, from which on a screw is backing out
constexpr double left_bone = 0.2_mm;    // without bone, after which a thread has left it [judgement]
constexpr double catching_up = 2.0;     // [–] by which crests that were pushed in cut faster than the helix
constexpr double flute_scale = 10.0_mm;
constexpr double tilt_arm = 10.0_mm;    // of a channel that turns [m]
constexpr double same_width = 0.05_mm;  // a groove that is narrower by no more needs no cutting

/// Along the thread at its mean radius: a unit motion there, as a rate of the tool.
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

/// Bone that the flutes have cut away does not press.
double pressed_share(const ScrewThread& thread, double relief) noexcept {
    return 1.0 - relief * (1.0 - exp_exact(-thread.flutes * thread.flute_length / flute_scale));
}

/// What the flutes have to cut where they are: the groove, or what a narrower tap has left of it [–].
double share_to_cut(const ThreadTrack& track, const ScrewThread& thread, double front) noexcept {
    const double z = thread.first_crest();
    const double tapped = track.share_tapped(front, 0.5 * thread.outer_at(z), 0.5 * thread.core_at(z));
    return 1.0 - tapped * tapped;
}

/// How far the first crest is from bone that it has not cut, along the shaft [m]: 0 at the front.
double way_to_front(const ThreadTrack& track, const ScrewThread& thread, double front) noexcept {
    if (!track.is_there()) return 0.0;
    const kerf_thread& groove = track.thread();
    const bool is_tapped = groove.tapped_radius >= 0.5 * thread.outer - same_width;
    return std::max(0.0, (is_tapped ? std::max(groove.to, groove.tapped_to) : groove.to) - front);
}

}  // namespace

void ScrewInsertion::begin(const HeldThread& tool, const BoneQuery&, State& state) const noexcept {
    Prepared& p = state.prepared;
    p.thread = tool.as<ThreadedTool>().thread();
    p.places = ThreadPlaces(p.thread);
    p.contact = ScrewContact(p.thread);
}

/// The thread keeps the tool on its axis.
void ScrewInsertion::add_track(const ThreadTrack& track, const BoneThread& found, Channels& channels) const noexcept {
    if (!track.is_there() || found.stiffness <= 0.0) return;
    const Vec3 beside = track.beside(found.middle), askew = track.askew();
    const double stiffness = found.left * found.stiffness, limit = found.left * found.pressed;
    if (stiffness <= 0.0 || limit <= 0.0) return;
    const auto hold = [&](std::uint32_t id, const Vec6& d, double k, double stretch, double most) {
        channels.hold({.id = id, .d = d, .stiffness = k, .stretch = stretch, .limit = most});
    };
    hold(id_beside_x, {1, 0, 0, 0, found.middle, 0}, stiffness, beside.x, limit);
    hold(id_beside_y, {0, 1, 0, -found.middle, 0, 0}, stiffness, beside.y, limit);
    const double spread = found.spread / tilt_arm;
    if (spread <= 0.0) return;
    hold(id_askew_x, {0, 0, 0, tilt_arm, 0, 0}, stiffness * spread * spread, tilt_arm * askew.x, limit * spread);
    hold(id_askew_y, {0, 0, 0, 0, tilt_arm, 0}, stiffness * spread * spread, tilt_arm * askew.y, limit * spread);
}

ScrewInsertion::Notes ScrewInsertion::resist(const HeldThread&, const BoneQuery& bone, const State& state,
                                             Channels& channels) const noexcept {
    const auto& [thread, places, contact] = state.prepared;
    const ThreadTrack track = ThreadTrack::found(bone, thread);
    const BoneThread found(places, thread, track, *this, bone);
    const Notes notes{.strength = found.strength,
                      .stiffness = found.stiffness,
                      .engaged = found.engaged,
                      .middle = found.middle,
                      .across = found.left * found.pressed,
                      .left = static_cast<float>(found.left),
                      .front = static_cast<float>(found.front_in_bone),
                      .spread = static_cast<float>(found.spread),
                      .body = found.body};
    const Slide slide(thread);

    if (found.strength > 0.0)
        channels.hold({.id = id_helix,
                       .d = helix_of(thread),
                       .stiffness = found.stiffness,
                       .stretch = state.stretch,
                       .limit = found.strength});
    const SinCos flank = sin_cos_exact(thread.flank_angle);
    const double pressed = found.left * pressed_share(thread, flute_relief) * found.rubbing / slide.radius,
                 carried = std::min(std::abs(state.grip_force), found.strength);
    if (const double limit = pressed + friction * carried / flank.cos; limit > 0.0)
        if (kerf_channel* c = channels.add(KERF_FRICTION, id_flanks, slide.d)) {
            c->tau = limit;
            c->w = creep;
        }
    const double front = track.depth_of({0, 0, thread.first_crest()});
    if (const double cut = share_to_cut(track, thread, front); thread.flutes > 0.0 && found.front > 0.0 && cut > 0.0)
        if (kerf_channel* c = channels.add(KERF_CUT, id_flutes, slide.d)) {
            c->tau = found.left * cut * chip * thread.groove_area(-thread.cone()) * found.front;
            c->w = cut_onset;
            c->gap = way_to_front(track, thread, front) / thread.advance() * slide.length;
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
    const double front = track.depth_of({0, 0, thread.first_crest()}) + along;

    state.stretch += along - thread.advance() * turn;
    const double slip = give_way(state.stretch, notes.stiffness, notes.strength);
    state.slip += slip;
    state.is_slipping = slip > 0.0;
    track.add_slip(front - thread.length, front, slip);

    if (groove.radius < 0.5 * thread.outer - same_width) {  // it widens the thread of a tap
        groove.radius = 0.5 * thread.outer;
        groove.to = std::max(groove.from, front - along);
    }
    if (turn > 0.0 && front > groove.to) {
        const double to = std::min(front, groove.to + catching_up * thread.advance() * turn);
        groove.volume += share_to_cut(track, thread, front) * static_cast<double>(notes.front) *
                         thread.groove_volume(thread.first_crest()) * (to - groove.to);
        groove.to = to;
    }
    if (thread.takes_chips_out && groove.to > groove.tapped_to) {
        groove.tapped_to = groove.to;
        groove.tapped_radius = std::max(groove.tapped_radius, 0.5 * thread.outer);
    }

    if (front < groove.tapped_to) return;  // what is ahead keeps its axis
    const double stiffness = static_cast<double>(notes.left) * notes.stiffness,
                 spread = static_cast<double>(notes.spread);
    const Vec3 beside = track.beside(notes.middle), askew = track.askew();
    Vec3 held = beside, turned = askew;
    static_cast<void>(give_way(held.x, stiffness, notes.across));
    static_cast<void>(give_way(held.y, stiffness, notes.across));
    static_cast<void>(give_way(turned.x, stiffness * spread * spread, notes.across * spread));
    static_cast<void>(give_way(turned.y, stiffness * spread * spread, notes.across * spread));
    track.give_way(beside - held, askew - turned, notes.middle);
}

void ScrewInsertion::change_phase(const Noted<Notes>& advance, State& state, Actions& actions) const noexcept {
    const Notes& notes = advance.notes;
    const bool is_back = state.angle < state.front - turned_back;
    // Crests that were pushed through on the way in are no stripped thread, nor is a tool that leaves through them.
    const bool is_stripped = state.is_slipping && state.slip > yield_slip &&
                             static_cast<double>(notes.left) < stripped_at &&
                             notes.engaged > state.prepared.thread.lead();
    const Phase before = state.phase;
    switch (state.phase) {
        case Phase::in_air:
            if (state.angle > bitten) state.phase = Phase::going_in;
            break;
        case Phase::going_in:
            if (state.seat_force > seated_force) {
                state.phase = Phase::seated;
                state.seated_at = state.angle;
            }
            [[fallthrough]];
        case Phase::seated:
            if (state.slip > first_slip) state.phase = Phase::slipping;
            [[fallthrough]];
        case Phase::slipping:
            if (is_stripped)
                state.phase = Phase::stripped;
            else if (is_back)
                state.phase = Phase::backing_out;
            break;
        case Phase::backing_out:
            if (is_stripped)
                state.phase = Phase::stripped;
            else if (!is_back)
                state.phase = state.slip > first_slip ? Phase::slipping : Phase::going_in;
            break;
        case Phase::stripped:
            break;
    }
    if (state.away > left_bone && state.phase != Phase::stripped) {
        state.phase = Phase::in_air;
        state.angle = state.front = state.slip = 0.0;
    }
    if (state.phase != before && state.phase != Phase::in_air)
        actions.event(static_cast<Happened>(static_cast<int>(state.phase) - 1));
}

void ScrewInsertion::commit(const HeldThread& tool, const BoneQuery& bone, const Noted<Notes>& advance, State& state,
                            Signals& signals, Actions& actions) const noexcept {
    const double dt = tool.tick.dt, turn = advance.rate[5] * dt;
    const ScrewThread& thread = state.prepared.thread;
    const Notes& notes = advance.notes;

    state.is_slipping = false;
    state.torque = 0.0;
    for (std::size_t c = 0; c < advance.channel.size(); ++c)
        state.torque += advance.channel[c].d[5] * advance.lambda[c];
    state.grip_force = advance.carried_by_id(id_helix);
    state.seat_force = std::max(0.0, advance.carried_by_id(ScrewContact::id_seat));
    if (notes.engaged > 0.0) {
        state.away = 0.0;
        state.angle += turn;
        state.front = std::max(state.front, state.angle);
        ThreadTrack track = ThreadTrack::found(bone, thread);
        if (track.is_crossed() && !state.is_crossed) actions.event(Happened::cross_threaded);
        state.is_crossed = track.is_crossed();
        if (!track.is_there() && turn > 0.0 && state.angle > bitten) track = ThreadTrack::begun(thread, notes.body);
        if (track.is_there()) {
            const bool was_whole = notes.left > 0.0f && notes.engaged > thread.lead();
            turn_in(advance, dt, track, state);
            if (was_whole && strength_left(track.slip_at(track.depth_of({0, 0, notes.middle})), yield_share, yield_slip,
                                           strip_slip) <= 0.0)
                actions.cut_thread();
            actions.leave(track.thread());
        } else {
            state.stretch = 0.0;
        }
    } else {
        state.stretch = 0.0;
        state.away += std::abs(advance.rate[2]) * dt;
    }
    change_phase(advance, state, actions);

    bool meets_bone = notes.engaged > 0.0;
    for (const kerf_channel& channel : advance.channel) meets_bone = meets_bone || channel.id == ScrewContact::id_tip;
    if (meets_bone) actions.cut();  // of the core; what is between the crests stays
    signals = {.torque = state.torque,
               .turned = state.angle,
               .engaged = notes.engaged,
               .clamp = state.seat_force,
               .slip = state.slip,
               .pull_out = notes.strength};
}

}  // namespace kerf::implant
