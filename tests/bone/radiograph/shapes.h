// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "bone/radiograph/attenuation_image.h"
#include "bone/radiograph/beam.h"
#include "bone/radiograph/metal_shadow.h"
#include "core/field/cut/cut_field.h"
#include "kerf/units.hpp"
#include "tests/support/block.h"

/// Bones and metal whose shadows can be worked out by hand.
namespace kerf::test {

/// A density whose attenuation is a whole number of steps of a voxel: 184, as cortical bone of 1.856 g/cm³.
inline constexpr int bone_value = 184;
inline constexpr double bone_density = (bone_value * bone::AttenuationImage::step - bone::water_attenuation) *
                                       bone::compact_bone_density /
                                       (bone::compact_bone_attenuation - bone::water_attenuation);
/// Its attenuation less that of water [1/m].
inline constexpr double excess = (bone_value - bone::AttenuationImage::water_value) * bone::AttenuationImage::step;

/// One material inside a surface, in a cube of ± `half` [m].
inline Body solid(double half, double spacing, const std::function<double(Vec3)>& distance) {
    Body body;
    body.id = "solid";
    body.surface = LevelSet::build(Grid::covering({-half, -half, -half}, {half, half, half}, spacing), distance);
    body.materials.push_back({"cortical", bone_density, {}});
    return body;
}
inline Body ball(double radius, double spacing) {
    return solid(radius + 6.0 * spacing, spacing, [=](Vec3 p) { return length(p) - radius; });
}

/// A bone with its cut at a pose.
struct Bone {
    Body body;
    CutField cut;
    explicit Bone(Body one) : body(std::move(one)), cut(body, 0) {}
    [[nodiscard]] bone::AttenuatingBody at(const Pose& pose = identity_pose()) const { return {&body, &cut, pose}; }
    /// Removes a cylinder along unit `direction`, from `from` to `to`.
    void drill(double radius, Vec3 from, Vec3 to) {
        const Vec3 along = normalized(to - from);
        const double reach = length(to - from);
        const ToolSolid bit({{0.0, radius}, {-reach, radius}});
        CutRecord record;
        record.sequence = sequence_++;
        record.from = record.to = pointing(to, along);
        cut.reserve(4096);
        cut.stamp(record, bit);
    }

private:
    std::uint64_t sequence_ = 0;
};

inline Box cube(double half) { return {{-half, -half, -half}, {half, half, half}}; }

/// A beam straight through the origin whose middle pixel (256, 256) lies on the axis.
inline bone::Beam through_origin(double about_head_axis, double tilt, double width = 0.16) {
    bone::Beam beam = bone::beam({0, 0, 0}, about_head_axis, tilt);
    beam.width = width;
    beam.columns = beam.rows = 513;
    return beam;
}
inline constexpr std::size_t middle_pixel = 256 * 513 + 256;

struct Mesh {
    std::vector<std::array<float, 3>> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    [[nodiscard]] bone::MetalShape shape(const Pose& pose = identity_pose(),
                                         double attenuation = bone::titanium_attenuation) const {
        return {positions, triangles, pose, attenuation};
    }
};

/// A closed cylinder about z, from −half to half.
inline Mesh cylinder(double radius, double half, std::uint32_t sides) {
    Mesh mesh;
    for (std::uint32_t i = 0; i < sides; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / sides;
        const float x = static_cast<float>(radius * std::cos(angle)), y = static_cast<float>(radius * std::sin(angle));
        mesh.positions.push_back({x, y, static_cast<float>(-half)});
        mesh.positions.push_back({x, y, static_cast<float>(half)});
    }
    mesh.positions.push_back({0, 0, static_cast<float>(-half)});
    mesh.positions.push_back({0, 0, static_cast<float>(half)});
    for (std::uint32_t i = 0; i < sides; ++i) {
        const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % sides);
        mesh.triangles.push_back({a, b, b + 1});
        mesh.triangles.push_back({a, b + 1, a + 1});
        mesh.triangles.push_back({2 * sides, b, a});
        mesh.triangles.push_back({2 * sides + 1, a + 1, b + 1});
    }
    return mesh;
}

}  // namespace kerf::test
