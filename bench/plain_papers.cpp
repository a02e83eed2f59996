// SPDX-License-Identifier: Apache-2.0
#include "bench/plain_papers.h"

#include <algorithm>
#include <cmath>

namespace kerf::bench {

PlainPapers::PlainPapers(Vec3 low, Vec3 high, double spacing, double density, const Drill& drill)
    : low_(low), spacing_(spacing), drill_(drill) {
    const Vec3 extent = (1.0 / spacing) * (high - low);
    size_[0] = static_cast<int>(extent.x + 0.5);
    size_[1] = static_cast<int>(extent.y + 0.5);
    size_[2] = static_cast<int>(extent.z + 0.5);
    voxels_.assign(
        static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]) * static_cast<std::size_t>(size_[2]),
        {static_cast<float>(density), true});

    const double slope = drill.point_depth / drill.radius;
    for (std::size_t n = 0; n < elements; ++n) {
        const double side = n % 2 == 0 ? 1.0 : -1.0;
        const double r = drill.radius * (static_cast<double>(n / 2) + 0.5) / (0.5 * elements);
        elements_.push_back(
            {{side * r, 0, -slope * r}, {0, 0, -4e4}, {0, -side * 5e4, 0}, drill.radius / (0.5 * elements)});
    }
    constexpr std::size_t around = 40, levels = contact_points / around;
    for (std::size_t level = 0; level < levels; ++level)
        for (std::size_t n = 0; n < around; ++n) {
            const double angle = 6.283185307179586 * static_cast<double>(n) / around;
            const double along = (static_cast<double>(level) + 0.5) / levels;
            const double z = -drill.point_depth - along * (drill.length - drill.point_depth);
            const Vec3 outwards{std::cos(angle), std::sin(angle), 0};
            contact_points_.push_back({drill.radius * outwards + Vec3{0, 0, z}, -outwards});
        }
}

const PlainPapers::Voxel* PlainPapers::nearest(Vec3 p) const {
    const int i = static_cast<int>(std::floor((p.x - low_.x) / spacing_));
    const int j = static_cast<int>(std::floor((p.y - low_.y) / spacing_));
    const int k = static_cast<int>(std::floor((p.z - low_.z) / spacing_));
    if (i < 0 || j < 0 || k < 0 || i >= size_[0] || j >= size_[1] || k >= size_[2]) return nullptr;
    return &voxels_[(static_cast<std::size_t>(k) * static_cast<std::size_t>(size_[1]) + static_cast<std::size_t>(j)) *
                        static_cast<std::size_t>(size_[0]) +
                    static_cast<std::size_t>(i)];
}

Vec6 PlainPapers::cutting(const Pose& body_from_tool, double feed_per_lip) const {
    Vec3 force{0, 0, 0}, torque{0, 0, 0};
    for (const Element& e : elements_) {
        const Voxel* voxel = nearest(body_from_tool * e.place);
        if (voxel == nullptr || !voxel->is_bone) continue;
        const double chip = static_cast<double>(voxel->density) * feed_per_lip * e.width;
        const Vec3 f = chip * (e.feed_force + e.cutting_force);
        force = force + f;
        torque = torque + cross(e.place, f);
    }
    return make_vec6(force, torque);
}

Vec6 PlainPapers::contact(const Pose& body_from_tool) const {
    constexpr double stiffness = 500.0;  // [N/m] of one point
    Vec3 force{0, 0, 0}, torque{0, 0, 0};
    for (const ContactPoint& c : contact_points_) {
        const Voxel* voxel = nearest(body_from_tool * c.place);
        if (voxel == nullptr || !voxel->is_bone) continue;
        const Vec3 f = stiffness * spacing_ * c.inwards;
        force = force + f;
        torque = torque + cross(c.place, f);
    }
    return make_vec6(force, torque);
}

std::size_t PlainPapers::remove(const Pose& body_from_tool) {
    const Pose tool_from_body = inverse(body_from_tool);
    const Vec3 tip = body_from_tool * Vec3{0, 0, 0}, end = body_from_tool * Vec3{0, 0, -drill_.length};
    const auto first = [&](double a, double b, double low) {
        return std::max(0, static_cast<int>(std::floor((std::min(a, b) - drill_.radius - low) / spacing_)));
    };
    const auto last = [&](double a, double b, double low, int size) {
        return std::min(size - 1, static_cast<int>(std::floor((std::max(a, b) + drill_.radius - low) / spacing_)));
    };
    std::size_t gone = 0;
    for (int k = first(tip.z, end.z, low_.z); k <= last(tip.z, end.z, low_.z, size_[2]); ++k)
        for (int j = first(tip.y, end.y, low_.y); j <= last(tip.y, end.y, low_.y, size_[1]); ++j)
            for (int i = first(tip.x, end.x, low_.x); i <= last(tip.x, end.x, low_.x, size_[0]); ++i) {
                const Vec3 centre = low_ + spacing_ * Vec3{i + 0.5, j + 0.5, k + 0.5};
                const Vec3 p = tool_from_body * centre;
                if (p.z > 0.0 || p.z < -drill_.length) continue;
                const double r = std::min(drill_.radius, -p.z * drill_.radius / drill_.point_depth);
                if (p.x * p.x + p.y * p.y > r * r) continue;
                Voxel& voxel = voxels_[(static_cast<std::size_t>(k) * static_cast<std::size_t>(size_[1]) +
                                        static_cast<std::size_t>(j)) *
                                           static_cast<std::size_t>(size_[0]) +
                                       static_cast<std::size_t>(i)];
                gone += voxel.is_bone ? 1 : 0;
                voxel.is_bone = false;
            }
    return gone;
}

}  // namespace kerf::bench
