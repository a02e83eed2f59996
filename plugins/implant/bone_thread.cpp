// SPDX-License-Identifier: Apache-2.0
#include "bone_thread.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "kerf/edge_law.hpp"
#include "thread_grip.h"

namespace kerf::implant {

namespace {

constexpr double core_clearance = 0.08e-3;  // [m] outside the core: there the bone removed by the core itself ends

/// Engagement of a crest in the wall of its hole.
struct Bite {
    double inner = 0.0;   ///< [m] radius from which on the crest is in bone
    double depth = 0.0;   ///< [m] of the crest in bone
    double middle = 0.0;  ///< [m] radius in the middle of the part in bone
    double press = 0.0;   ///< [–] pressure on the core, relative to the pressure at which bone yields

    Bite() = default;
    Bite(double outer, double core, double hole, double yield_strain) noexcept
        : inner(std::min(std::max(core, hole), outer)),
          depth(outer - inner),
          middle(0.5 * (outer + inner)),
          press(std::clamp((core - hole) / (yield_strain * core), 0.0, 1.0)) {}
};

}  // namespace

ThreadPoints::ThreadPoints(const ScrewThread& thread) noexcept {
    ThreadPiece pieces[max_pieces];
    count = make_pieces(thread, pieces);
    for (int i = 0; i < count; ++i) {
        const auto n = static_cast<std::size_t>(i);
        const double z = pieces[i].point.z, radius = thread.mean_radius(z);
        direction[n] = {pieces[i].point.x / radius, pieces[i].point.y / radius, z};
        outer[n] = 0.5 * thread.outer_at(z);
        core[n] = 0.5 * thread.core_at(z);
        grip[n] = pieces[i].length;
    }
    piece = pieces[0].length;
}

double ThreadPoints::moved_in(const ThreadTrack& track) const noexcept {
    if (!track.is_there()) return 0.0;
    const double at = track.depth_of({0, 0, direction[0].z}) / piece;
    return (std::floor(at + 0.5) - at) * piece;
}

BoneThread::BoneThread(const ThreadPoints& thread_points, const ScrewThread& thread, const ThreadTrack& track,
                       const HoleBefore& hole, const ScrewParameters& law, const BoneQuery& bone) noexcept {
    const auto count = static_cast<std::size_t>(thread_points.count);
    const double moved = thread_points.moved_in(track);
    const SinCos turned = sin_cos_exact(moved / thread.advance());
    std::array<Vec3, 2 * max_pieces> point{};  // the middle of the crests in bone, then next to the core
    std::array<Bite, max_pieces> bites{};
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3& direction = thread_points.direction[i];
        const Vec3 out{turned.cos * direction.x - turned.sin * direction.y,
                       turned.sin * direction.x + turned.cos * direction.y, 0.0};
        const Vec3 on_axis{0, 0, direction.z + moved};
        bites[i] = Bite(thread_points.outer[i], thread_points.core[i], hole.radius_at(on_axis.z), law.yield_strain);
        point[i] = on_axis + bites[i].middle * out;
        point[count + i] = on_axis + (thread_points.core[i] + core_clearance) * out;
    }
    std::array<kerf_bone_sample, 2 * max_pieces> found;
    bone.sample(std::span<const Vec3>(point.data(), 2 * count), Vec3{0, 0, 1}, {found.data(), 2 * count});
    leading = last = thread.first_crest();
    bool has_front = false;
    const double full_depth = 0.5 * (thread.outer - thread.core);
    double flutes = 0.0, first_quarter = 0.0, whole = 0.0, square = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const Bite& crest = bites[i];
        const double outer = thread_points.outer[i], core = thread_points.core[i], z = point[i].z,
                     length = thread_points.grip[i];
        const bool bites_bone = crest.depth > 0.0;
        const double m = bites_bone ? resistance(found[i], bone.tissue_count(), reference_density) : 0.0;
        // The first and the last piece make up for the shift of the others.
        const double part = i == 0           ? 1.0 - moved / thread_points.piece
                            : i + 1 == count ? 1.0 + moved / thread_points.piece
                                             : 1.0;
        if (-z <= thread.cone() + thread.flute_length) {
            const double fraction = crest.depth / (outer - core);
            front += m * fraction * fraction;  // the groove is a triangle
            flutes += 1.0;
        }
        if (m > 0.0 && !has_front) {
            has_front = true;
            leading = i == 0 ? thread.first_crest() : z + 0.5 * thread_points.piece;
        }
        if (m > 0.0) last = z - 0.5 * thread_points.piece;
        if (has_front && z >= leading - 0.25 * thread.lead()) {
            front_in_bone += bites_bone ? found[i].engagement : 0.0;
            first_quarter += 1.0;
        }
        const double on_core = crest.press * resistance(found[count + i], bone.tissue_count(), reference_density);
        const double depth = track.depth_of(point[i]);
        const bool is_cut = track.is_cut_at(depth);
        const double relieved = 1.0 - law.tapped_relief * track.fraction_tapped(depth, outer, core);
        // All friction acts at the thread's radius, as the torque in foam scales with it [weidling-2022].
        rubbing += part * relieved * law.friction * law.compaction * crest.middle * length *
                   (m * thread.flank_between(crest.inner, outer) + on_core * 2.0 * pi * core);
        if (m <= 0.0) continue;
        engaged += part * found[i].engagement * length;
        if (found[i].body >= 0) body = found[i].body;
        if (!is_cut) {
            blocked += part * law.crush * m * thread.flank_between(crest.inner, outer) * length;
            continue;
        }
        const double strong = part * law.shear * m * 2.0 * pi * outer * thread.shape_factor_of(crest.depth) * length,
                     stiff = part * 1e3 * law.grip_stiffness * m * length;  // stiffness of 1 mm, per metre
        const double slip = track.slip_at(depth);
        whole += strong;
        strength += strong * strength_left(slip, law.yield_share, law.yield_slip, law.strip_slip);
        lost += strong * slip;
        bite += strong * crest.depth / full_depth;
        stiffness += stiff;
        pressed += part * law.crush * m * 2.0 * outer * length;
        middle += stiff * z;
        square += stiff * z * z;
    }
    if (flutes > 0.0) front /= flutes;
    if (first_quarter > 0.0) front_in_bone /= first_quarter;
    if (whole > 0.0) {
        left = strength / whole;
        lost /= whole;
        bite = std::min(bite / whole, 1.0);
    }
    if (stiffness > 0.0) {
        middle /= stiffness;
        spread = std::sqrt(std::max(0.0, square / stiffness - middle * middle));
    }
}

}  // namespace kerf::implant
