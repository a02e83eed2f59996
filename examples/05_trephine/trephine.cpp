// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <kerf/edge_law.hpp>
#include <kerf/remesh_refine.hpp>
#include <kerf/strategy.hpp>
#include <vector>

using namespace kerf;
using remeshing::Triangles;

// ---- the tool: a tube whose rim cuts a ring; the core inside stays
// ----------------------------------------------------

struct Trephine {
    double diameter, wall;
    static constexpr auto about() {
        return describe("trephine", "A tube with teeth on its rim.", strategies("example.trephine.core"),
                        param(&Trephine::diameter, {.id = "diameter",
                                                    .help = "Outer diameter.",
                                                    .unit = unit::mm,
                                                    .min = 4_mm,
                                                    .max = 20_mm,
                                                    .def = 8_mm,
                                                    .source = "assumed: order of trephines for iliac crest grafts"}),
                        param(&Trephine::wall, {.id = "wall",
                                                .help = "Thickness of its wall.",
                                                .unit = unit::mm,
                                                .min = 0.3_mm,
                                                .max = 2_mm,
                                                .def = 0.8_mm,
                                                .source = "assumed"}));
    }
    double outer() const { return diameter / 2; }
    double inner() const { return diameter / 2 - wall; }
    Outline outline() const {
        if (!(2 * wall < diameter))
            return refuse("`wall` is ", in_mm(wall), "; it needs less than half of `diameter`.");
        return revolution({{0, outer()}, {-40_mm, outer()}})
            .cuts()
            .hollow(inner())
            .to(-60_mm, outer())
            .gripped_at(-90_mm);
    }
};

// The law: F = p m(ρ) A under the rim, with A its area. The walls outside and inside guide it.

struct RingSaw {
    double pressure;
    struct Signals {
        double thrust = 0.0;
    };
    struct State {};
    static constexpr auto about() {
        return describe("ring_saw", "The rim takes chips from the ring of bone under it.",
                        work({.channels = 9, .points = 16, .queries = 9}),
                        param(&RingSaw::pressure, {.id = "pressure",
                                                   .help = "Thrust per area of the rim in dense bone.",
                                                   .unit = unit::N_per_mm2,
                                                   .min = 0.1_N_per_mm2,
                                                   .max = 50_N_per_mm2,
                                                   .def = 2_N_per_mm2,
                                                   .source = "assumed"}),
                        signal(&Signals::thrust, {.id = "thrust", .help = "Push of the bone.", .unit = unit::N}));
    }
    void resist(const Held<Trephine>& tool, const BoneQuery& bone, const State&, Channels& channels) const noexcept {
        constexpr std::size_t around = 8;
        const double middle = (tool.outer() + tool.inner()) / 2, area = 2 * pi * middle * tool.wall;
        std::array<Vec3, around> rim;
        for (std::size_t i = 0; i < around; ++i) {
            const SinCos angle = sin_cos_exact(2 * pi * static_cast<double>(i) / around);
            rim[i] = {middle * angle.cos, middle * angle.sin, 0};
        }
        std::array<kerf_bone_sample, around> found;
        bone.sample(rim, {0, 0, 1}, found);
        double resisted = 0, engaged = 0, gap = 1;
        for (const kerf_bone_sample& here : found) {
            const double m = resistance(here, bone.tissue_count(), 1850.0);
            if (m <= 0) continue;
            resisted += m / around;
            engaged += here.engagement / around;
            gap = std::min(gap, here.gap);
        }
        if (resisted > 0)
            channels.cut({.id = 0,
                          .along = {0, 0, 1},
                          .edge_force = pressure * area * resisted,
                          .onset = 0.1_mm_per_s,
                          .slope = 2000 * engaged,
                          .gap = gap});
        for (std::uint32_t i = 0; i < 8; ++i) {  // four points outside of its slot, four on the core
            const Vec3 side = rim[i] / middle,
                       at = (i % 2 == 0 ? tool.outer() : tool.inner()) * side - Vec3{0, 0, 4_mm};
            if (const SurfacePoint s = bone.nearest(at); s.is_within(0.3_mm))
                channels.contact({.id = 1 + i, .at = at, .along = -s.normal, .stiffness = 3e5, .depth = -s.distance});
        }
    }
    void commit(const Held<Trephine>&, const BoneQuery&, const Advance& advance, State&, Signals& signals,
                Actions& actions) const noexcept {
        signals.thrust = advance.force_of_channel(0);
        if (signals.thrust > 0) actions.cut();
    }
};

// The strategy: the ring of the surface sinks to the deepest rim.

struct Core {
    double tolerance;
    static constexpr auto about() {
        return describe("core", "Sinks a ring of the surface along the tube; for one straight cut that leaves a floor.",
                        remeshes_whole("core 1"),
                        param(&Core::tolerance, {.id = "tolerance",
                                                 .help = "Longest edge across the ring.",
                                                 .unit = unit::mm,
                                                 .min = 0.05_mm,
                                                 .max = 0.5_mm,
                                                 .def = 0.08_mm,
                                                 .source = "chosen"}));
    }
    RemeshAnswer remesh(const RemeshJob& job) const {
        const std::vector<SweptTool> cuts = job.cuts();
        Pose deepest = cuts.front().to;
        for (const SweptTool& cut : cuts)
            if ((inverse(deepest) * cut.to.position).z > 0) deepest = cut.to;
        const Pose tool_from_body = inverse(deepest);
        for (const SweptTool& cut : cuts)  // a tube on one straight way
            for (const Pose& pose : {cut.from, cut.to}) {
                const Vec3 tip = tool_from_body * pose.position, end = tool_from_body * (pose * Vec3{0, 0, -40_mm});
                if (cut.bore <= 0 || std::hypot(tip.x, tip.y) > 0.1_mm || std::hypot(end.x, end.y) > 0.2_mm)
                    return RemeshAnswer::declined("it is no tube that goes straight along its axis");
            }
        const double outer = cuts.front().profile.front().radius, inner = cuts.front().bore,
                     back = cuts.front().profile.back().z;
        const auto outside = [&](Vec3 p) {  // of the tube's way, behind its deepest rim [m]
            const double r = std::hypot(p.x, p.y);
            return std::max({r - outer, inner - r, p.z, back - p.z});
        };
        Triangles mesh = job.mesh();
        for (Vec3& v : mesh.vertices) v = tool_from_body * v;
        remeshing::split_long_edges(mesh, {}, tolerance,
                                    [&](Vec3 middle, double span) { return outside(middle) < span / 2; });
        bool has_changed = false;
        for (std::size_t f = 0; f < mesh.tags.size(); ++f) {
            const std::uint32_t* t = &mesh.triangles[3 * f];
            const Vec3 a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
            if (outside(a) >= 0 && outside(b) >= 0 && outside(c) >= 0) continue;
            if (cross(b - a, c - a).z > 0) return RemeshAnswer::declined("the tube comes out of the bone");
            mesh.tags[f] = KERF_FACE_WALL;
            has_changed = true;
        }
        if (!has_changed) return RemeshAnswer::unchanged();
        const Triangles before = job.mesh();
        for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
            Vec3& p = mesh.vertices[v];
            const bool sinks = outside(p) < 0;
            if (sinks) p.z = 0;
            p = !sinks && v < before.vertices.size() ? before.vertices[v] : deepest * p;  // bit for bit where it was
        }
        return RemeshAnswer::cut(std::move(mesh));
    }
};

KERF_PLUGIN("example.trephine", "0.1.0", "Apache-2.0", Trephine, RingSaw, Core)
