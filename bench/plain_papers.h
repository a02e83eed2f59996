// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "kerf/math.hpp"

/// Drilling as the papers describe it, written plainly: what a tick of ours is measured against.
namespace kerf::bench {

/// A dense array of voxels, each whole or gone. Every tick asks the nearest voxel of each cutting element and of each
/// point on the shank, one after the other, and then takes away every voxel of the tool's bounding box whose centre
/// lies in the tool. Nothing is left out, nothing is remembered from the tick before.
class PlainPapers {
public:
    struct Drill {
        double radius, point_depth, length;  ///< [m]; the length that can be in bone
    };
    static constexpr std::size_t elements = 500;         ///< on two lips
    static constexpr std::size_t contact_points = 2000;  ///< on the shank

    /// Bone of one density fills the box.
    PlainPapers(Vec3 low, Vec3 high, double spacing, double density, const Drill& drill);

    /// Wrench of the elements on the tool, tool frame [N, N·m].
    [[nodiscard]] Vec6 cutting(const Pose& body_from_tool, double feed_per_lip) const;
    /// The same of the shank's points.
    [[nodiscard]] Vec6 contact(const Pose& body_from_tool) const;
    /// How many voxels went.
    std::size_t remove(const Pose& body_from_tool);

private:
    struct Voxel {
        float density;
        bool is_bone;
    };
    struct Element {
        Vec3 place, feed_force, cutting_force;  ///< forces per density and area
        double width;
    };
    struct ContactPoint {
        Vec3 place, inwards;
    };
    [[nodiscard]] const Voxel* nearest(Vec3 p) const;

    Vec3 low_;
    double spacing_;
    int size_[3];
    Drill drill_;
    std::vector<Voxel> voxels_;
    std::vector<Element> elements_;
    std::vector<ContactPoint> contact_points_;
};

}  // namespace kerf::bench
