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

constexpr std::uint32_t id_helix = 0, id_flanks = 1, id_flutes = 2, id_head = 3;
constexpr double creep = 1e-6;          // [m/s] below which friction is a stiff damper: a screw at rest stays
constexpr double cut_onset = 1e-4;      // [m/s]
constexpr double seated_force = 5.0;    // [N] under the head from which on it counts as seated [judgement]
constexpr double first_slip = 0.02_mm;  // from there on a thread yields [judgement]
constexpr double stripped_at = 0.3;     // [–] of its strength left, at which a thread counts as stripped
constexpr double turned_back = 0.3;     // [rad] behind the farthest turn, from which on a screw is backing out
constexpr double flute_scale = 10.0_mm;

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
    /// [N·m] of torque for 1 N along the thread.
    [[nodiscard]] double arm() const noexcept { return d[5]; }
};

Vec6 helix_of(const ScrewThread& thread) noexcept { return {0, 0, 1, 0, 0, -thread.advance()}; }

/// Bone that the flutes have cut away does not press.
double pressed_share(const ScrewThread& thread, double relief) noexcept {
    return 1.0 - relief * (1.0 - exp_exact(-thread.flutes * thread.flute_length / flute_scale));
}

}  // namespace

void ScrewInsertion::begin(const Held<PedicleScrew>& screw, const BoneQuery&, State& state) const noexcept {
    Prepared& p = state.prepared;
    p.thread = screw.thread();
    p.places = ThreadPlaces(p.thread);
    p.contact = ScrewContact(p.thread);
}

ScrewInsertion::Notes ScrewInsertion::resist(const Held<PedicleScrew>&, const BoneQuery& bone, const State& state,
                                             Channels& channels) const noexcept {
    const auto& [thread, places, contact] = state.prepared;
    const BoneThread found(places, thread, *this, bone);
    const double left = left_of(state.grip);
    const Notes notes{left * found.strength, left * found.stiffness, found.engaged};
    const Slide slide(thread);

    if (notes.strength > 0.0)
        channels.hold({.id = id_helix,
                       .d = helix_of(thread),
                       .stiffness = notes.stiffness,
                       .stretch = state.grip.stretch,
                       .limit = notes.strength});
    const SinCos flank = sin_cos_exact(thread.flank_angle);
    const double pressed = left * pressed_share(thread, flute_relief) * found.rubbing / slide.radius,
                 carried = std::min(std::abs(state.grip_force), notes.strength);
    if (const double limit = pressed + friction * carried / flank.cos; limit > 0.0)
        if (kerf_channel* c = channels.add(KERF_FRICTION, id_flanks, slide.d)) {
            c->tau = limit;
            c->w = creep;
        }
    if (thread.flutes > 0.0 && found.front > 0.0)
        if (kerf_channel* c = channels.add(KERF_CUT, id_flutes, slide.d)) {
            c->tau = left * chip * thread.groove_area(-thread.cone()) * found.front;
            c->w = cut_onset;
            c->gap = std::max(0.0, state.front - state.angle) * slide.length;
        }
    contact.add_to(channels, *this, bone);
    if (state.seat_force > 0.0 && head_friction > 0.0)
        if (kerf_channel* c =
                channels.add(KERF_FRICTION, id_head, Vec6{0, 0, 0, 0, 0, 0.25 * (thread.outer + thread.head)})) {
            c->tau = head_friction * state.seat_force;
            c->w = creep;
        }
    return notes;
}

void ScrewInsertion::commit(const Held<PedicleScrew>& screw, const BoneQuery&, const Noted<Notes>& advance,
                            State& state, Signals& signals, Actions& actions) const noexcept {
    const double dt = screw.tick.dt, turn = advance.rate[5] * dt;
    const ScrewThread& thread = state.prepared.thread;
    const Notes& notes = advance.notes;
    const Phase before = state.phase;

    state.torque = 0.0;
    for (std::size_t c = 0; c < advance.channel.size(); ++c)
        state.torque += advance.channel[c].d[5] * advance.lambda[c];
    state.grip_force = advance.carried_by_id(id_helix);
    state.seat_force = std::max(0.0, advance.carried_by_id(ScrewContact::id_seat));
    if (notes.engaged > 0.0) {
        state.angle += turn;
        state.front = std::max(state.front, state.angle);
        state.grip.move(advance.rate[2] * dt - thread.advance() * turn, notes.stiffness, notes.strength);
        state.beside = {};
    } else {
        // The bone that it slipped in is still there: it is known again if the screw comes back the same way.
        state.beside.move(advance.rate, dt);
        state.grip.stretch = 0.0;
        if (state.beside.is_elsewhere(0.5 * thread.outer)) {
            state.phase = Phase::in_air;
            state.angle = state.front = 0.0;
            state.grip.let_go();
        }
    }

    const bool is_back = state.angle < state.front - turned_back;
    switch (state.phase) {
        case Phase::in_air:
            if (notes.engaged > 0.0) state.phase = Phase::going_in;
            break;
        case Phase::going_in:
            if (state.seat_force > seated_force) {
                state.phase = Phase::seated;
                state.seated_at = state.angle;
            }
            [[fallthrough]];
        case Phase::seated:
            if (state.grip.slip > first_slip) state.phase = Phase::slipping;
            [[fallthrough]];
        case Phase::slipping:
            if (state.grip.slip > yield_slip && left_of(state.grip) < stripped_at)
                state.phase = Phase::stripped;
            else if (is_back)
                state.phase = Phase::backing_out;
            break;
        case Phase::backing_out:
            if (!is_back) state.phase = state.grip.slip > first_slip ? Phase::slipping : Phase::going_in;
            break;
        case Phase::stripped:
            break;
    }
    if (state.phase != before && state.phase != Phase::in_air)
        actions.event(static_cast<Happened>(static_cast<int>(state.phase) - 1));

    bool meets_bone = notes.engaged > 0.0;
    for (const kerf_channel& channel : advance.channel) meets_bone = meets_bone || channel.id == ScrewContact::id_tip;
    if (meets_bone) actions.cut();  // of the core; what is between the crests stays
    signals = {.torque = state.torque,
               .turned = state.angle,
               .engaged = notes.engaged,
               .clamp = state.seat_force,
               .slip = state.grip.slip,
               .pull_out = notes.strength};
}

}  // namespace kerf::implant
