// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <kerf/remesh_refine.hpp>
#include <kerf/strategy.hpp>
#include <optional>
#include <utility>
#include <vector>

using namespace kerf;
using remeshing::Triangles;

/// A ball that moves straight from one point to another.
struct SweptBall {
    Vec3 from, to;
    double radius;

    Vec3 nearest_on_path(Vec3 point) const {
        const Vec3 path = to - from;
        const double all = dot(path, path), t = all > 0.0 ? dot(point - from, path) / all : 0.0;
        return from + std::min(1.0, std::max(0.0, t)) * path;
    }
    double outside(Vec3 point) const { return length(point - nearest_on_path(point)) - radius; }
    Vec3 onto(Vec3 point) const {
        const Vec3 centre = nearest_on_path(point);
        return centre + radius * normalized(point - centre);
    }
};

/// The ball that a tool's outline lies on, to 1 %; nothing if there is none.
std::optional<SweptBall> ball_of(const SweptTool& cut) {
    if (cut.kerf > 0.0 || cut.profile.size() < 3) return std::nullopt;
    const kerf_profile_point a = cut.profile.front(), b = cut.profile.back();
    const double centre = (a.z * a.z + a.radius * a.radius - b.z * b.z - b.radius * b.radius) / (2 * (a.z - b.z));
    const double radius = std::hypot(a.z - centre, a.radius);
    for (const kerf_profile_point& p : cut.profile)
        if (std::abs(std::hypot(p.z - centre, p.radius) - radius) > 0.01 * radius) return std::nullopt;
    return SweptBall{cut.from * Vec3{0, 0, centre}, cut.to * Vec3{0, 0, centre}, radius};
}

/// Moves what lies in a ball's path onto the ball, away from the path of its centre: a groove no deeper than the ball's
/// half.
struct Groove {
    double tolerance;

    static constexpr auto about() {
        return describe("groove",
                        "Moves the surface onto the ball that has passed; for grooves less than half as deep.",
                        remeshes_patches("groove 1"),
                        param(&Groove::tolerance, {.id = "tolerance",
                                                   .help = "Longest edge, by which the rim may be off.",
                                                   .unit = unit::mm,
                                                   .min = 0.05_mm,
                                                   .max = 1_mm,
                                                   .def = 0.1_mm,
                                                   .source = "chosen"}));
    }
    RemeshAnswer remesh(const RemeshJob& job) const {
        Triangles mesh = job.mesh();
        const auto locked = job.locked();
        bool has_changed = false;
        for (const SweptTool& cut : job.cuts()) {
            const auto ball = ball_of(cut);
            if (!ball) return RemeshAnswer::declined("its tool is no ball");
            remeshing::split_long_edges(mesh, locked, tolerance,
                                        [&](Vec3 middle, double span) { return ball->outside(middle) < 0.5 * span; });
            std::vector<char> is_inside;
            for (const Vec3 v : mesh.vertices) is_inside.push_back(ball->outside(v) < 0.0);
            for (std::size_t v = 0; v < locked.size(); ++v)
                if (is_inside[v] && locked[v]) return RemeshAnswer::refused("the ball reaches a locked vertex");
            for (std::size_t f = 0; f < mesh.tags.size(); ++f) {
                const std::uint32_t* t = &mesh.triangles[3 * f];
                if (!is_inside[t[0]] && !is_inside[t[1]] && !is_inside[t[2]]) continue;
                const Vec3 a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
                const Vec3 middle = (a + b + c) / 3.0;
                if (dot(cross(b - a, c - a), ball->nearest_on_path(middle) - middle) <= 0.0)
                    return RemeshAnswer::declined("a face in the way looks away from the path of the ball's centre");
                mesh.tags[f] = KERF_FACE_WALL;
                has_changed = true;
            }
            for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
                if (is_inside[v]) mesh.vertices[v] = ball->onto(mesh.vertices[v]);
        }
        return has_changed ? RemeshAnswer::cut(std::move(mesh)) : RemeshAnswer::unchanged();
    }
};

KERF_PLUGIN("example.ball_groove", "0.1.0", "Apache-2.0", Groove)
