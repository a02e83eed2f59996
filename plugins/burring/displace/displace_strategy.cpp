// SPDX-License-Identifier: Apache-2.0
#include "displace_strategy.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "displace.h"
#include "kerf/remesh_solids.hpp"

namespace kerf::burring {

namespace displacement {
namespace {

/// [–] fraction of the tolerance that a face may be off the burr. All faces lie on one side of it, so errors add up.
constexpr double wall_fraction = 0.25;

/// Returns the defect that prevents any work on a request; empty if there is none.
std::string flaw_of(const Triangles& mesh, double tolerance) {
    if (mesh.tags.empty()) return "the mesh has no faces";
    if (!std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [](Vec3 v) { return is_finite(v); }))
        return "a vertex of the mesh is no number";
    for (std::size_t f = 0; f < mesh.tags.size(); ++f) {
        const std::uint32_t *t = &mesh.triangles[3 * f], count = static_cast<std::uint32_t>(mesh.vertices.size());
        if (t[0] >= count || t[1] >= count || t[2] >= count)
            return "face " + std::to_string(f) + " has a vertex that does not exist";
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return "face " + std::to_string(f) + " has a vertex twice";
    }
    if (!(tolerance > 0.0) || !std::isfinite(tolerance)) return "the tolerance is no length";
    return {};
}

bool less(Vec3 a, Vec3 b) noexcept { return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z; }

/// Locked vertices by position, because each cut renumbers vertices.
class Locked {
public:
    Locked(const Triangles& mesh, std::span<const std::uint8_t> flags) {
        for (std::size_t v = 0; v < flags.size(); ++v)
            if (flags[v] != 0) positions_.push_back(mesh.vertices[v]);
        std::sort(positions_.begin(), positions_.end(), less);
    }
    [[nodiscard]] std::vector<std::uint8_t> among(const Triangles& mesh) const {
        std::vector<std::uint8_t> flags;
        for (const Vec3 v : mesh.vertices)
            flags.push_back(std::binary_search(positions_.begin(), positions_.end(), v, less));
        return flags;
    }

private:
    std::vector<Vec3> positions_;
};

}  // namespace
}  // namespace displacement

RemeshAnswer Displace::remesh(const RemeshJob& job) const {
    using namespace displacement;
    using remeshing::convex_runs;
    Triangles mesh = job.mesh();
    std::string why = flaw_of(mesh, job.tolerance());
    if (!why.empty()) return RemeshAnswer::refused(why);
    const Locked locked(mesh, job.locked());
    bool has_changed = false;
    for (const SweptTool& cut : job.cuts()) {
        if (cut.bore > 0.0) return RemeshAnswer::declined("the tool is hollow");
        for (const remeshing::Profile run : cut.kerf == 0.0 ? convex_runs(cut.profile) : std::vector{cut.profile}) {
            const auto burr = SweptBurr::make(run, cut.kerf, cut.from, cut.to, why);
            if (!burr) return RemeshAnswer::declined(why);
            Triangles next = mesh;
            const Outcome outcome = displacement::displace(next, locked.among(mesh), *burr,
                                                           wall_fraction * job.tolerance(), job.cancelled(), why);
            if (outcome == Outcome::unchanged) continue;
            if (outcome != Outcome::cut) return RemeshAnswer::of(outcome, {}, why);
            mesh = std::move(next);
            has_changed = true;
        }
    }
    return has_changed ? RemeshAnswer::cut(std::move(mesh)) : RemeshAnswer::unchanged();
}

}  // namespace kerf::burring
