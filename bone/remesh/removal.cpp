// SPDX-License-Identifier: Apache-2.0
#include "bone/remesh/removal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "bone/remesh/new_faces.h"
#include "bone/remesh/swept_before.h"
#include "bone/surface/diagnose.h"
#include "bone/surface/triangle_tree.h"
#include "core/field/cut/sweep.h"

namespace kerf::bone {
namespace {

Box box_around(const std::array<Vec3, 3>& c) {
    return {
        {std::min({c[0].x, c[1].x, c[2].x}), std::min({c[0].y, c[1].y, c[2].y}), std::min({c[0].z, c[1].z, c[2].z})},
        {std::max({c[0].x, c[1].x, c[2].x}), std::max({c[0].y, c[1].y, c[2].y}), std::max({c[0].z, c[1].z, c[2].z})}};
}

/// The sweeps of a request's cuts.
class Swept {
public:
    explicit Swept(const RemeshRequest& request) {
        for (const CutStretch& cut : request.cuts) {
            const ToolSolid& solid = *request.solids[cut.solid];
            all_.push_back(
                {Sweep(solid, cut.from, cut.to, std::max(largest_motion(solid, cut.from, cut.to), 1e-6), 0.0),
                 swept_box(solid, cut)});
        }
    }
    /// Returns whether a point is deeper than `depth` [m] in one of the sweeps; a negative depth extends the sweeps
    /// outwards.
    [[nodiscard]] bool contains(Vec3 point, double depth) const {
        const double margin = std::max(0.0, -depth);
        return std::any_of(all_.begin(), all_.end(), [&](const One& one) {
            return is_in(point, one.box, margin) && one.sweep.contains(point, depth);
        });
    }

    [[nodiscard]] bool meets(const Box& box) const {
        return std::any_of(all_.begin(), all_.end(), [&](const One& one) { return meet(one.box, box); });
    }

private:
    static bool is_in(Vec3 p, const Box& box, double margin) noexcept {
        return p.x >= box.low.x - margin && p.x <= box.high.x + margin && p.y >= box.low.y - margin &&
               p.y <= box.high.y + margin && p.z >= box.low.z - margin && p.z <= box.high.z + margin;
    }
    struct One {
        Sweep sweep;
        Box box;
    };
    std::vector<One> all_;
};

Vec3 middle_of(const SurfaceMesh& mesh, const Triangle& t) {
    const auto c = mesh.corners(t);
    return (c[0] + c[1] + c[2]) / 3.0;
}

/// Returns the largest faces for which `is_candidate` is true, up to a limit of cost. Small faces lie between large
/// ones.
template <class IsCandidate>
std::vector<std::size_t> largest_faces(const SurfaceMesh& mesh, bool is_patch, const IsCandidate& is_candidate) {
    const std::size_t largest = is_patch ? 256 : 8192;
    std::vector<std::pair<double, std::size_t>> all;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        if (!is_candidate(f)) continue;
        const auto c = mesh.corners(mesh.triangles[f]);
        all.emplace_back(-length(cross(c[1] - c[0], c[2] - c[0])), f);
    }
    if (all.size() > largest) {
        std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(largest), all.end());
        all.resize(largest);
    }
    std::vector<std::size_t> faces;
    for (const auto& [area, face] : all) faces.push_back(face);
    std::sort(faces.begin(), faces.end());
    return faces;
}

std::string at(Vec3 point) { return "at " + position_text(point); }

/// Finds a point of a face in the path of a tool. Depth changes no faster than a point moves, so its value in the
/// middle bounds it over the whole face. If this bound does not decide, the face is halved, down to `spacing`.
class Rest {
public:
    Rest(const Swept& swept, double allowed, double spacing) : swept_(&swept), allowed_(allowed), spacing_(spacing) {}

    [[nodiscard]] std::optional<Vec3> find_in(Vec3 a, Vec3 b, Vec3 c) const {
        const Vec3 middle = (a + b + c) / 3.0;
        const double radius = std::max({length(a - middle), length(b - middle), length(c - middle)});
        if (swept_->contains(middle, allowed_)) return middle;
        if (radius <= spacing_ || !swept_->contains(middle, allowed_ - radius)) return std::nullopt;
        // A face on the wall: between points of the wall a convex solid is at most a few times `allowed` deep.
        if (swept_->contains(a, -allowed_) && swept_->contains(b, -allowed_) && swept_->contains(c, -allowed_))
            return std::nullopt;
        const double ab = length(b - a), bc = length(c - b), ca = length(a - c);
        if (bc >= ab && bc >= ca) return find_in_halves(b, c, a);
        return ca >= ab ? find_in_halves(c, a, b) : find_in_halves(a, b, c);
    }

private:
    [[nodiscard]] std::optional<Vec3> find_in_halves(Vec3 a, Vec3 b, Vec3 c) const {
        const Vec3 middle = 0.5 * (a + b);
        const auto found = find_in(a, middle, c);
        return found ? found : find_in(middle, b, c);
    }
    const Swept* swept_;
    double allowed_, spacing_;
};

/// Returns a quarter of the smallest thickness of the tools [m]: smaller complete pieces of bone cannot be in their
/// path.
double spacing_of(const RemeshRequest& request, double allowed) {
    double thinnest = HUGE_VAL;
    for (const ToolSolid* solid : request.solids)
        if (!solid->outline().empty())
            thinnest =
                std::min(thinnest, solid->is_prism() ? solid->thickness() : solid->largest_radius() - solid->bore());
    return std::max(allowed, 0.25 * thinnest);
}

/// Returns the first remaining bone in the path of a tool.
std::string flaw_of_rest(const SurfaceMesh& mesh, const RemeshRequest& request, const Swept& swept, double allowed) {
    const Rest rest(swept, allowed, spacing_of(request, allowed));
    const auto meets = [&](std::size_t face) {
        const auto c = mesh.corners(mesh.triangles[face]);
        return swept.meets(box_around(c));
    };
    for (const std::size_t face : largest_faces(mesh, !request.locked.empty(), meets)) {
        const auto corners = mesh.corners(mesh.triangles[face]);
        if (const auto point = rest.find_in(corners[0], corners[1], corners[2]))
            return "bone is left in the path of the tool, " + at(*point);
    }
    return {};
}

}  // namespace

std::string flaw_of_removal(const RemeshRequest& request, const TaggedMesh& result, double allowed) {
    const SurfaceMesh &before = request.base.mesh, &after = result.mesh;
    const Swept swept(request);
    if (std::string flaw = flaw_of_rest(after, request, swept, allowed); !flaw.empty()) return flaw;
    const std::vector<std::uint8_t> is_new = new_faces_of(after, before), is_removed = new_faces_of(before, after);
    const TriangleTree base(before), left(after);
    const bool is_patch = !request.locked.empty();
    for (const std::size_t face : largest_faces(after, is_patch, [&](std::size_t f) { return is_new[f] != 0; })) {
        const Vec3 point = middle_of(after, after.triangles[face]);
        if (base.distance(point, 2.0 * allowed) > allowed && !swept.contains(point, -allowed))
            return "a new face lies neither on the mesh as it was nor on what the tool sweeps, " + at(point);
    }
    for (const std::size_t face : largest_faces(before, is_patch, [&](std::size_t f) { return is_removed[f] != 0; })) {
        const Vec3 point = middle_of(before, before.triangles[face]);
        if (left.distance(point, 2.0 * allowed) > allowed && !swept.contains(point, -allowed))
            return "bone is missing that the tool did not sweep, " + at(point);
    }
    return {};
}

std::string flaw_of_unchanged(const RemeshRequest& request, double allowed) {
    std::string flaw = flaw_of_rest(request.base.mesh, request, Swept(request), allowed);
    return flaw.empty() ? flaw : "it returns the mesh as it was, and " + flaw;
}

double allowed_for(const RemeshRequest& request, double tolerance) {
    constexpr double nudges = 2e-6;
    return std::max(tolerance, request.tolerance) + 2.0 * request.tolerance + nudges;
}

}  // namespace kerf::bone
