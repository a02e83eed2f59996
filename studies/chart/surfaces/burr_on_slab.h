// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "bone/remesh/cut_path.h"
#include "bone/remesh/tagged_mesh.h"
#include "bone/surface/surface_mesh.h"
#include "kerf/remesh.h"

/// A round burr and a slab of bone, whose grooves and holes have known volumes. For training and research; not for
/// diagnosis, planning or deciding treatment.
namespace kerf::chart {

/// The cutting part of a ball burr: a polyline of `pieces` chords with its points on the ball.
inline ToolSolid ball_burr(double radius, int pieces = 128) {
    std::vector<kerf_profile_point> outline;
    for (int i = 0; i <= pieces; ++i) {
        const double angle = std::numbers::pi * i / pieces;
        outline.push_back({radius * (std::cos(angle) - 1.0), i == 0 || i == pieces ? 0.0 : radius * std::sin(angle)});
    }
    return ToolSolid(outline);
}

/// A box with its top in the plane z = 0 and its middle under the origin, of squares `square` wide or a little less,
/// each in two triangles.
inline bone::SurfaceMesh slab(double along, double across, double height, double square) {
    const auto steps = [square](double size) { return std::max(1, static_cast<int>(std::ceil(size / square))); };
    const int nx = steps(along), ny = steps(across), nz = steps(height);
    bone::SurfaceMesh mesh;
    std::vector<std::int64_t> numbers(static_cast<std::size_t>((nx + 1) * (ny + 1) * (nz + 1)), -1);
    const auto at = [&](int i, int j, int k) {
        std::int64_t& number = numbers[static_cast<std::size_t>((k * (ny + 1) + j) * (nx + 1) + i)];
        if (number < 0) {
            number = static_cast<std::int64_t>(mesh.vertices.size());
            mesh.vertices.push_back({along * (static_cast<double>(i) / nx - 0.5),
                                     across * (static_cast<double>(j) / ny - 0.5),
                                     height * (static_cast<double>(k) / nz - 1.0)});
        }
        return static_cast<std::uint32_t>(number);
    };
    const auto square_of = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
    };
    for (int i = 0; i < nx; ++i)
        for (int j = 0; j < ny; ++j) {
            square_of(at(i, j, nz), at(i + 1, j, nz), at(i + 1, j + 1, nz), at(i, j + 1, nz));
            square_of(at(i, j, 0), at(i, j + 1, 0), at(i + 1, j + 1, 0), at(i + 1, j, 0));
        }
    for (int k = 0; k < nz; ++k) {
        for (int i = 0; i < nx; ++i) {
            square_of(at(i, 0, k), at(i + 1, 0, k), at(i + 1, 0, k + 1), at(i, 0, k + 1));
            square_of(at(i, ny, k), at(i, ny, k + 1), at(i + 1, ny, k + 1), at(i + 1, ny, k));
        }
        for (int j = 0; j < ny; ++j) {
            square_of(at(0, j, k), at(0, j, k + 1), at(0, j + 1, k + 1), at(0, j + 1, k));
            square_of(at(nx, j, k), at(nx, j + 1, k), at(nx, j + 1, k + 1), at(nx, j, k + 1));
        }
    }
    return mesh;
}

/// A tool over the slab that looks down, its tip there.
inline Pose burr_at(Vec3 tip) { return {tip, quat_between({0, 0, 1}, {0, 0, -1})}; }

/// A burr's tips one after the other as straight stretches.
inline std::vector<bone::CutStretch> stretches_along(const std::vector<Vec3>& tips) {
    std::vector<bone::CutStretch> cuts;
    for (std::size_t i = 1; i < tips.size(); ++i) cuts.push_back({burr_at(tips[i - 1]), burr_at(tips[i]), 0});
    return cuts;
}
/// From one tip to another in steps of about `feed`.
inline std::vector<bone::CutStretch> in_steps(Vec3 from, Vec3 to, double feed) {
    const int count = std::max(1, static_cast<int>(std::round(length(to - from) / feed)));
    std::vector<Vec3> tips;
    for (int i = 0; i <= count; ++i) tips.push_back(from + (static_cast<double>(i) / count) * (to - from));
    return stretches_along(tips);
}

/// The least angle of each face of a wall [rad], ascending.
inline std::vector<double> min_angles_of_walls(const bone::TaggedMesh& mesh) {
    std::vector<double> angles;
    for (std::size_t f = 0; f < mesh.tags.size(); ++f) {
        if (mesh.tags[f] != KERF_FACE_WALL) continue;
        const auto c = mesh.mesh.corners(mesh.mesh.triangles[f]);
        double least = std::numbers::pi;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 u = c[(i + 1) % 3] - c[i], v = c[(i + 2) % 3] - c[i];
            least = std::min(least, std::atan2(length(cross(u, v)), dot(u, v)));
        }
        angles.push_back(least);
    }
    std::sort(angles.begin(), angles.end());
    return angles;
}

/// Volumes by hand [m³], of a ball of radius R in bone with a flat top, `d` ≤ R deep.
///     slot area   A = R² acos((R − d)/R) − (R − d) √(2 R d − d²)
///     dimple      V = π d² (3 R − d)/3
inline double slot_area(double radius, double depth) {
    const double rest = radius - depth;
    return radius * radius * std::acos(rest / radius) - rest * std::sqrt(2.0 * radius * depth - depth * depth);
}
inline double dimple_volume(double radius, double depth) {
    return std::numbers::pi * depth * depth * (3.0 * radius - depth) / 3.0;
}

}  // namespace kerf::chart
