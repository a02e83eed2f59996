// SPDX-License-Identifier: Apache-2.0
#include "reciprocating_impulse.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace kerf::papers {

using namespace sawing;

namespace {

/// Impulses at each tooth for one feed rate.
struct Blow {
    std::array<double, max_teeth> pressed{};  ///< [N·s] along the tooth's normal
    std::array<double, max_teeth> dragged{};  ///< [N·s] along x, on the blade
};

/// Teeth that strike: teeth in bone at the front, at any density, because bone is rigid here.
struct Striking {
    std::array<std::size_t, max_teeth> tooth;
    std::array<double, max_teeth> engaged{};  ///< [–] of each tooth
    std::size_t count = 0;
};
Striking striking(const TeethInBone& in_bone) noexcept {
    Striking found;
    const double least = in_bone.min_gap(0, in_bone.teeth.count);
    for (std::size_t i = 0; i < in_bone.teeth.count; ++i) {
        double engaged = 0.0;
        for (const std::size_t point : {2 * i, 2 * i + 1})
            if (in_bone.resisted[point] > 0.0 && in_bone.gap[point] <= least + max_cutting_gap)
                engaged += 0.5 * in_bone.engagement[point];
        if (engaged <= 0.0) continue;
        found.engaged[i] = engaged;
        found.tooth[found.count++] = i;
    }
    return found;
}

/// Returns the impulses of a blade with the feed `feed` [m/s] whose teeth move at `along` [m/s].
Blow blow_of(const ReciprocatingImpulse& law, const StraightBlade& blade, const Teeth& teeth, const Striking& which,
             double feed, double along) noexcept {
    const double of_inertia = 1.0 / (law.mass * law.gyration * law.gyration);
    const RigidTool tool{law.mass, {of_inertia, of_inertia, of_inertia}};
    std::array<Strike, max_teeth> strike;
    for (std::size_t n = 0; n < which.count; ++n) {
        const Tooth& tooth = teeth.tooth[which.tooth[n]];
        // The teeth have cut the front themselves: it faces them. In its middle plane, as neighbours are set by turns.
        strike[n].r = Vec3{tooth.tip.x, 0.0, tooth.tip.z - blade.middle_z()};
        strike[n].normal = -tooth.normal;
        strike[n].softness = (1.0 / which.engaged[which.tooth[n]] - 1.0) / law.mass;
    }
    solve_strikes(tool, {{along, 0.0, feed}, {0.0, 0.0, 0.0}}, {law.restitution, law.friction},
                  {strike.data(), which.count});
    Blow blow;
    for (std::size_t n = 0; n < which.count; ++n) {
        blow.pressed[which.tooth[n]] = dot(strike[n].impulse, strike[n].normal);
        blow.dragged[which.tooth[n]] = strike[n].impulse.x;
    }
    return blow;
}

/// Adds the feed channels: each sector resists with Σ p ν. Returns the force along the teeth per thrust [–].
double add_impulse_feed(const ReciprocatingImpulse& law, const StraightBlade& blade, const TeethInBone& in_bone,
                        const Oscillation& motion, double last_feed_rate, Channels& channels) noexcept {
    constexpr double min_feed = 0.1e-3;  // [m/s] impulses are proportional to the feed where the teeth slide
    const double feed = std::max(last_feed_rate, min_feed);
    const Striking which = striking(in_bone);
    if (which.count == 0) return 0.0;

    // Both strokes, half of the time each, so that their drag along the blade cancels.
    const double speed = motion.stroke.mean_speed();
    const Blow to = blow_of(law, blade, in_bone.teeth, which, feed, speed),
               fro = blow_of(law, blade, in_bone.teeth, which, feed, -speed);
    const double fading = std::clamp((motion.stroke.rate - slowest_strike) / (full_strike - slowest_strike), 0.02, 1.0);
    const double rate = strikes_per_second(motion.stroke) / fading;
    const std::size_t n = in_bone.teeth.count;
    double all_pressed = 0.0, all_dragged = 0.0;
    for (std::size_t sector = 0; sector < sector_count; ++sector) {
        const std::size_t first = sector * n / sector_count, last = (sector + 1) * n / sector_count;
        double pressed = 0.0;
        Vec6 d{};
        for (std::size_t i = first; i < last; ++i) {
            const double impulse = 0.5 * (to.pressed[i] + fro.pressed[i]);
            const Tooth& tooth = in_bone.teeth.tooth[i];
            const Vec6 into = rate_at({tooth.tip.x, 0.0, tooth.tip.z}, tooth.normal);
            for (std::size_t c = 0; c < 6; ++c) d[c] += impulse * into[c];
            pressed += impulse;
            all_dragged += 0.5 * (std::abs(to.dragged[i]) + std::abs(fro.dragged[i]));
        }
        if (pressed <= 0.0) continue;
        all_pressed += pressed;
        for (double& component : d) component /= pressed;
        kerf_channel* channel = channels.add(KERF_CUT, id_feed + static_cast<std::uint32_t>(sector * part_count), d);
        if (channel == nullptr) continue;
        channel->eta = motion.cutting.fraction * rate * pressed / feed;
        channel->gap = in_bone.min_gap(first, last);
    }
    return all_pressed > 0.0 ? all_dragged / all_pressed : 0.0;
}

}  // namespace

double strikes_per_second(const Stroke& stroke) noexcept {
    return 2.0 * stroke.rate * std::max(1.0, stroke.length / stroke.pitch);
}

void ReciprocatingImpulse::begin(const Held<ReciprocatingBlade>& saw, const BoneQuery& bone,
                                 State& state) const noexcept {
    prepare_saw(saw.blade(), *this, bone, state.prepared);
}

ReciprocatingImpulse::Notes ReciprocatingImpulse::resist(const Held<ReciprocatingBlade>& saw, const BoneQuery& bone,
                                                         const State& state, Channels& channels) const noexcept {
    const auto& [blade, touching_in_cut, touching] = state.prepared;
    const Oscillation motion = oscillation_of(blade, saw.stroke_rate, state);
    Notes notes;
    if (motion.cutting.resists()) {
        TeethInBone in_bone;
        in_bone.sample(*this, bone, blade, motion);
        notes.teeth = {.engaged = in_bone.engaged, .resisting = in_bone.resisting()};
        notes.along_per_thrust = add_impulse_feed(*this, blade, in_bone, motion, state.feed_rate, channels);
        if (motion.cutting.removes_bone()) add_side_cutting(in_bone, blade, *this, bone, motion, channels);
    }
    add_contact(blade, motion.cutting.removes_bone() ? touching_in_cut : touching, *this, bone, motion, state.slot,
                state.binding, channels);
    return notes;
}

void ReciprocatingImpulse::commit(const Held<ReciprocatingBlade>& saw, const BoneQuery& bone,
                                  const Noted<Notes>& advance, State& state, Signals& signals,
                                  Actions& actions) const noexcept {
    const StraightBlade& blade = state.prepared.blade;
    const Oscillation motion = oscillation_of(blade, saw.stroke_rate, state);
    const double load =
        commit_saw(blade, *this, motion, bone, advance, {advance.notes.teeth, advance.notes.along_per_thrust},
                   saw.tick.dt, state, signals, actions);
    signals.strike_rate = signals.stroke_rate > 0.0 ? strikes_per_second(motion.stroke) : 0.0;
    state.cutter.step(saw.motor(), saw.stroke_rate, load, saw.tick.dt, slowest_strike, phase_events<Happened>, actions);
    watch_torque(advance, blade, torque_threshold, saw.tick.dt, state, signals, actions);
}

}  // namespace kerf::papers
