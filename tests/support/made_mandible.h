// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "bone/surface/surface_mesh.h"
#include "core/field/grid/body.h"
#include "kerf/units.hpp"

/// Half a mandible out of two prisms, whose angles are known because it is made with them.
namespace kerf::test {

/// A point of the sagittal plane: y to posterior, z to the head [m].
using namespace literals;
using Sagittal = std::array<double, 2>;

/// A prism across the sagittal plane.
struct Prism {
    std::vector<Sagittal> outline;   ///< anticlockwise seen from the left (+x); its first corner sees all others
    double right = 0.0, left = 0.0;  ///< [m] x of its faces, right below left
};

/// The ramus leans `gonial_angle` away from the body, whose lower border falls by `slope` towards the chin [rad].
struct MadeMandible {
    double gonial_angle = 120.0_deg, slope = 25.0_deg;
    double notch = 3.0_mm;    ///< how far the lower border rises in front of the gonion
    double middle = 40.0_mm;  ///< x of the middle of this side; negative: the right side
    double half_width = 6.0_mm;

    static constexpr double body_length = 70e-3, body_height = 24e-3, ramus_length = 55e-3, ramus_width = 30e-3;

    /// From the gonion towards the chin, and up the ramus.
    [[nodiscard]] Sagittal forwards() const { return {-std::cos(slope), -std::sin(slope)}; }
    [[nodiscard]] Sagittal upwards() const {
        const double angle = pi + slope - gonial_angle;
        return {std::cos(angle), std::sin(angle)};
    }
    [[nodiscard]] Vec3 gonion() const { return {middle, 0, 0}; }
    [[nodiscard]] Vec3 menton() const { return at(forwards(), body_length); }
    [[nodiscard]] Vec3 condylion() const { return at(upwards(), ramus_length); }
    [[nodiscard]] Vec3 at(Sagittal way, double distance) const {
        return {middle, distance * way[0], distance * way[1]};
    }

    [[nodiscard]] std::vector<Prism> prisms() const {
        const Sagittal f = forwards(), u = upwards();
        const Sagittal above{-f[1], f[0]};  // from the lower border into the body
        const Sagittal in_front{-u[1], u[0]};
        const double sign = above[1] > 0.0 ? 1.0 : -1.0, front = in_front[0] < 0.0 ? 1.0 : -1.0;
        const auto in_body = [&](double along, double up) {
            return Sagittal{along * f[0] + up * sign * above[0], along * f[1] + up * sign * above[1]};
        };
        const auto in_ramus = [&](double along, double forth) {
            return Sagittal{along * u[0] + forth * front * in_front[0], along * u[1] + forth * front * in_front[1]};
        };
        const double right = middle - half_width, left = middle + half_width;
        Prism body{{in_body(25.0_mm, body_height), in_body(0, body_height), in_body(0, 0), in_body(14.0_mm, 0),
                    in_body(20.0_mm, notch), in_body(28.0_mm, notch), in_body(45.0_mm, 0), in_body(body_length, 0),
                    in_body(body_length, body_height)},
                   right,
                   left};
        Prism ramus{
            {in_ramus(0, 0), in_ramus(ramus_length, 0), in_ramus(ramus_length, ramus_width), in_ramus(0, ramus_width)},
            right,
            left};
        // What the body has behind the ramus's posterior border would be another border.
        body.outline =
            clipped(body.outline, [&](Sagittal p) { return front * (p[0] * in_front[0] + p[1] * in_front[1]); });
        ramus.outline = clipped(ramus.outline, [&](Sagittal p) { return sign * (p[0] * above[0] + p[1] * above[1]); });
        for (Prism* prism : {&body, &ramus}) make_anticlockwise(prism->outline);
        return {body, ramus};
    }

    /// Closed; anticlockwise seen from outside. The prisms overlap.
    [[nodiscard]] bone::SurfaceMesh mesh() const {
        bone::SurfaceMesh made;
        for (const Prism& prism : prisms()) {
            const auto first = static_cast<std::uint32_t>(made.vertices.size());
            const auto n = static_cast<std::uint32_t>(prism.outline.size());
            for (const double x : {prism.right, prism.left})
                for (const Sagittal& p : prism.outline) made.vertices.push_back({x, p[0], p[1]});
            for (std::uint32_t i = 1; i + 1 < n; ++i) {
                made.triangles.push_back({first + n, first + n + i, first + n + i + 1});
                made.triangles.push_back({first, first + i + 1, first + i});
            }
            for (std::uint32_t i = 0; i < n; ++i) {
                const std::uint32_t next = (i + 1) % n;
                made.triangles.push_back({first + i, first + next, first + n + next});
                made.triangles.push_back({first + i, first + n + next, first + n + i});
            }
        }
        return made;
    }

    /// Signed distance to the union; inside a lower bound.
    [[nodiscard]] double distance(Vec3 p) const {
        double least = HUGE_VAL;
        for (const Prism& prism : prisms_) {
            const double aside = std::abs(p.x - 0.5 * (prism.left + prism.right)) - 0.5 * (prism.left - prism.right);
            const double flat = distance_to_outline(prism.outline, {p.y, p.z});
            least = std::min(
                least, std::hypot(std::max(flat, 0.0), std::max(aside, 0.0)) + std::min(std::max(flat, aside), 0.0));
        }
        return least;
    }

    /// The same as a field, turned by `turned` about the origin.
    [[nodiscard]] Body body(double spacing, Quat turned = {1, 0, 0, 0}) {
        prisms_ = prisms();
        const double r = 90.0_mm;
        const Vec3 centre = rotate(turned, Vec3{middle, -20.0_mm, 10.0_mm});
        Body made;
        made.id = "mandible";
        made.surface = LevelSet::build(Grid::covering(centre - Vec3{r, r, r}, centre + Vec3{r, r, r}, spacing),
                                       [&](Vec3 p) { return distance(rotate(conjugate(turned), p)); });
        made.materials.push_back({"cortical", 1850.0, {}});
        return made;
    }

private:
    template <class Inside>
    static std::vector<Sagittal> clipped(const std::vector<Sagittal>& outline, const Inside& inside) {
        std::vector<Sagittal> kept;
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const Sagittal p = outline[i], q = outline[(i + 1) % outline.size()];
            const double a = inside(p), b = inside(q);
            constexpr double on = -1e-12;
            if (a >= on) kept.push_back(p);
            if ((a > -on && b < on) || (a < on && b > -on))
                kept.push_back({p[0] + a / (a - b) * (q[0] - p[0]), p[1] + a / (a - b) * (q[1] - p[1])});
        }
        return kept;
    }
    static void make_anticlockwise(std::vector<Sagittal>& outline) {
        double area = 0.0;
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const Sagittal p = outline[i], q = outline[(i + 1) % outline.size()];
            area += p[0] * q[1] - p[1] * q[0];
        }
        if (area < 0.0) std::reverse(outline.begin() + 1, outline.end());
    }
    static double distance_to_outline(const std::vector<Sagittal>& outline, Sagittal p) {
        double least = HUGE_VAL;
        bool is_inside = false;
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const Sagittal a = outline[i], b = outline[(i + 1) % outline.size()];
            const double ey = b[0] - a[0], ez = b[1] - a[1], wy = p[0] - a[0], wz = p[1] - a[1];
            const double t = std::clamp((wy * ey + wz * ez) / (ey * ey + ez * ez), 0.0, 1.0);
            least = std::min(least, std::hypot(wy - t * ey, wz - t * ez));
            if ((a[1] > p[1]) != (b[1] > p[1]) && p[0] < a[0] + (p[1] - a[1]) / ez * ey) is_inside = !is_inside;
        }
        return is_inside ? -least : least;
    }

    std::vector<Prism> prisms_{};
};

/// A surface turned about the origin.
inline bone::SurfaceMesh turned(bone::SurfaceMesh mesh, Quat by) {
    for (Vec3& v : mesh.vertices) v = rotate(by, v);
    return mesh;
}
/// The other side: left becomes right.
inline bone::SurfaceMesh mirrored(bone::SurfaceMesh mesh) {
    for (Vec3& v : mesh.vertices) v.x = -v.x;
    for (bone::Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
}

}  // namespace kerf::test
