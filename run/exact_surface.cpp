// SPDX-License-Identifier: Apache-2.0
#include "run/exact_surface.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/field/fnv1a.h"
#include "core/field/removed_volume.h"
#include "core/import/mesh_body.h"
#include "core/import/surface/edges.h"
#include "core/remesh/accept.h"
#include "core/remesh/base_mesh.h"
#include "core/remesh/local_cutting.h"

namespace kerf {
namespace {

constexpr int most_refusals = 4;  // of one result

std::string text_of(double volume) { return rounded(volume * 1e9, 1) + " mm3"; }

/// The surface that cuts of a body begin with.
std::optional<SurfaceMesh> base_of(const Scene& scene, const Body& bone, ExactSurface& made) {
    std::string flaw;
    if (&bone == &scene.body && scene.anatomy.mesh && !scene.fragment) {
        Diagnostics ignored;  // it was read when the scene was made
        if (const auto read = make_mesh_bone(scene.anatomy, ignored)) {
            SurfaceMesh surface = whole_surface_of(*read);
            flaw = flaw_of_base(surface);
            if (flaw.empty()) {
                made.notes.emplace_back("Base: the anatomy's own surface.");
                return surface;
            }
            made.notes.push_back("The anatomy's own surface cannot be cut exactly: " + flaw +
                                 ". The surface of the field is used instead.");
        }
    }
    SurfaceMesh surface = field_surface(bone);
    flaw = flaw_of_base(surface);
    if (flaw.empty()) {
        made.notes.push_back("Base: the surface of the field of `" + bone.id + "`.");
        return surface;
    }
    made.error = "the surface of `" + bone.id + "` cannot be cut exactly: " + flaw + ".";
    return std::nullopt;
}

/// A part of a mesh that hangs together.
struct Part {
    TaggedMesh mesh;
    double volume = 0.0;  ///< [m³] negative: a cavity
};

std::vector<Part> parts_of(const TaggedMesh& whole) {
    const Pieces pieces = pieces_of(whole.mesh, half_edges_of(whole.mesh));
    std::vector<Part> parts(pieces.count);
    std::vector<std::uint32_t> numbers(whole.mesh.vertices.size(), 0);
    // A vertex belongs to one part: parts that share one would be pinched, which no accepted mesh is.
    std::vector<bool> is_taken(whole.mesh.vertices.size(), false);
    for (std::size_t f = 0; f < whole.mesh.triangles.size(); ++f) {
        TaggedMesh& part = parts[pieces.of_face[f]].mesh;
        Triangle t = whole.mesh.triangles[f];
        for (std::uint32_t& corner : t) {
            if (!is_taken[corner]) {
                is_taken[corner] = true;
                numbers[corner] = static_cast<std::uint32_t>(part.mesh.vertices.size());
                part.mesh.vertices.push_back(whole.mesh.vertices[corner]);
            }
            corner = numbers[corner];
        }
        part.mesh.triangles.push_back(t);
        part.tags.push_back(whole.tags[f]);
    }
    for (Part& part : parts) part.volume = signed_volume_of(part.mesh.mesh);
    return parts;
}

void append(const TaggedMesh& more, TaggedMesh& mesh) {
    const auto first = static_cast<std::uint32_t>(mesh.mesh.vertices.size());
    mesh.mesh.vertices.insert(mesh.mesh.vertices.end(), more.mesh.vertices.begin(), more.mesh.vertices.end());
    for (const Triangle& t : more.mesh.triangles)
        mesh.mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    mesh.tags.insert(mesh.tags.end(), more.tags.begin(), more.tags.end());
}

/// A body of bone at the end, and the records that made it what it is.
struct Remains {
    std::size_t body;
    std::vector<CutRecord> records;
};

/// Whether bone of a body lies at one of the eight samples around a point.
bool touches(const Body& bone, const CutField& cut, Vec3 point) {
    const Grid& grid = bone.grid();
    const Vec3 at = (1.0 / grid.spacing) * (point - grid.origin);
    const int i = static_cast<int>(std::floor(at.x)), j = static_cast<int>(std::floor(at.y)),
              k = static_cast<int>(std::floor(at.z));
    for (int n = 0; n < 8; ++n) {
        const BrickPlace place =
            locate(grid, grid.sample_position(i + (n & 1), j + (n >> 1 & 1), k + (n >> 2)) + Vec3{1e-9, 1e-9, 1e-9});
        if (place.is_inside && std::max(uncut_distance(bone, place), cut.at(place)) < 0.0) return true;
    }
    return false;
}

/// The fraction of a part's vertices, as far as the field reaches, that lie beside bone of any of some bodies; nothing
/// where the field reaches none.
std::optional<double> fraction_on(const Part& part, const Body& bone, const PresentBone& present,
                                  const std::vector<Remains>& bodies) {
    std::size_t on = 0, all = 0;
    for (const Vec3 v : part.mesh.mesh.vertices) {
        if (!locate(bone.grid(), v).is_inside || !bone.region.contains(v)) continue;
        ++all;
        on += std::any_of(bodies.begin(), bodies.end(),
                          [&](const Remains& one) { return touches(bone, present.cut(one.body), v); });
    }
    if (all == 0) return std::nullopt;
    return static_cast<double>(on) / static_cast<double>(all);
}

double wall_area_of(const TaggedMesh& mesh) {
    double area = 0.0;
    for (std::size_t f = 0; f < mesh.tags.size(); ++f) {
        if (mesh.tags[f] == KERF_FACE_SURFACE) continue;
        const auto [a, b, c] = mesh.mesh.corners(mesh.mesh.triangles[f]);
        area += 0.5 * length(cross(b - a, c - a));
    }
    return area;
}

bool are_equal(const CutRecord& a, const CutRecord& b) {
    return a.sequence == b.sequence && a.tick == b.tick && a.body == b.body && a.solid == b.solid;
}

/// The bodies that are left, by the bone that they were part of.
std::vector<std::pair<const Body*, std::vector<Remains>>> remains_of(const Simulation& simulation) {
    std::vector<std::pair<const Body*, std::vector<Remains>>> all;
    const PresentBone& present = simulation.present();
    for (std::size_t body = 0; body < present.count(); ++body) {
        const LiveBody& live = *simulation.bodies()[body];
        if (!live.is_cuttable || !live.is_present) continue;
        const PresentPiece& piece = present.piece(body);
        auto same = std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.first == piece.bone; });
        if (same == all.end()) same = all.insert(all.end(), {piece.bone, {}});
        same->second.push_back({body, piece.history.records()});
    }
    return all;
}

/// How many records all of them begin with.
std::size_t common_count(const std::vector<Remains>& bodies) {
    std::size_t count = bodies.front().records.size();
    for (const Remains& one : bodies) {
        count = std::min(count, one.records.size());
        for (std::size_t n = 0; n < count; ++n)
            if (!are_equal(one.records[n], bodies.front().records[n])) count = n;
    }
    return count;
}

/// Bodies whose next record is the same came apart later; those that have no further one are done.
std::vector<std::vector<Remains>> parted_after(std::vector<Remains> bodies, std::size_t count) {
    std::vector<std::vector<Remains>> groups;
    for (Remains& one : bodies) {
        const auto same = std::find_if(groups.begin(), groups.end(), [&](const std::vector<Remains>& group) {
            const auto& records = group.front().records;
            return one.records.size() > count && records.size() > count &&
                   are_equal(one.records[count], records[count]);
        });
        if (same != groups.end())
            same->push_back(std::move(one));
        else
            groups.push_back({std::move(one)});
    }
    return groups;
}

/// What each number in the cut log removes.
std::vector<const ToolSolid*> cutting_solids(const Scene& scene) {
    std::vector<const ToolSolid*> solids;
    for (const Tool& tool : scene.tools) solids.push_back(&tool.outline.cutting);
    for (const Tool& tool : scene.tools) solids.push_back(&tool.outline.crest);
    return solids;
}

std::uint64_t digest_of(const std::vector<ExactPiece>& pieces) {
    Fnv1a hash;
    const auto add = [&](const auto& values) {
        for (const auto& value : values) {
            const auto* bytes = reinterpret_cast<const unsigned char*>(&value);
            for (std::size_t n = 0; n < sizeof value; ++n) hash.add_bytes(bytes[n], 1);
        }
    };
    for (const ExactPiece& piece : pieces) {
        hash.add_bytes(piece.body, 8);
        add(piece.mesh.mesh.vertices);
        add(piece.mesh.mesh.triangles);
        add(piece.mesh.tags);
    }
    return hash.value();
}

/// Makes the pieces of one bone.
class ExactCutting {
public:
    /// Pre: `bodies` are all that is left of the bone.
    ExactCutting(const Simulation& simulation, RemeshChild& child, const Body& bone, std::vector<Remains> bodies,
                 const std::vector<const ToolSolid*>& solids, const ExactOptions& options, ExactSurface& made)
        : present_(&simulation.present()),
          child_(&child),
          bone_(&bone),
          bodies_(std::move(bodies)),
          meshes_(bodies_.size()),
          solids_(&solids),
          options_(&options),
          made_(&made) {}

    /// Cuts the bone's uncut surface and adds the pieces. Returns false, with an error, where that fails.
    bool make_pieces(TaggedMesh uncut) {
        if (!cut(std::move(uncut), bodies_, 0)) return false;
        // What a body gets late was cut by another body's records; it lacks those of its own that came after.
        is_late_ = true;
        for (std::size_t n = 0; n < late_.size(); ++n) {
            const Late late = std::move(late_[n]);
            if (!cut(late.mesh, {bodies_[late.body]}, late.done)) return false;
        }
        for (std::size_t n = 0; n < bodies_.size(); ++n) keep(bodies_[n].body, std::move(meshes_[n]));
        return true;
    }

private:
    /// A part that is found to be another body's.
    struct Late {
        TaggedMesh mesh;
        std::size_t body;  ///< number in `bodies_`
        std::size_t done;  ///< records of that body that it was cut by
    };

    /// Cuts a mesh by what its bodies have in common after their first `done` records, parts it among them, and goes on
    /// with each. Returns false, with an error, where that fails.
    bool cut(TaggedMesh mesh, const std::vector<Remains>& bodies, std::size_t done) {
        const std::size_t common = common_count(bodies);
        RemeshRequest request;
        request.base = std::move(mesh);
        request.solids = *solids_;
        request.tolerance = options_->tolerance;
        const auto& records = bodies.front().records;
        std::vector<CutRecord> now(records.begin() + static_cast<std::ptrdiff_t>(done),
                                   records.begin() + static_cast<std::ptrdiff_t>(common));
        std::erase_if(now, [&](const CutRecord& record) { return (*solids_)[record.solid]->outline().empty(); });
        const double apart = bone_->grid().spacing;
        request.cuts =
            without_covered(stretches_of(now, *solids_, options_->tolerance), *solids_, options_->tolerance, apart);
        if (request.base.mesh.triangles.empty()) request.cuts.clear();
        made_->records += now.size();
        made_->stretches += request.cuts.size();
        std::optional<TaggedMesh> cut = request.cuts.empty()                   ? std::move(request.base)
                                        : child_->scope() == KERF_REMESH_PATCH ? cut_locally(request)
                                                                               : cut_by(request);
        if (!cut) return false;

        std::vector<std::vector<Remains>> groups = parted_after(bodies, common);
        std::vector<TaggedMesh> meshes(groups.size());
        for (const Part& part : parts_of(*cut)) share_out(part, groups, common, meshes);
        for (std::size_t g = 0; g < groups.size(); ++g) {
            if (groups[g].size() == 1 && groups[g].front().records.size() == common)
                append(meshes[g], meshes_[number_of(groups[g].front())]);
            else if (!this->cut(std::move(meshes[g]), groups[g], common))
                return false;
        }
        return true;
    }

    /// The strategy's result, as the host takes it; nothing, with an error, where it takes none.
    std::optional<TaggedMesh> cut_by(RemeshRequest& request) {
        if (options_->progress)
            options_->progress(0.0, "cutting " + std::to_string(request.base.mesh.triangles.size()) + " faces along " +
                                        std::to_string(request.cuts.size()) + " straight stretches");
        std::string why;
        for (int n = 0; n <= most_refusals; ++n) {
            if (is_cancelled()) return cancelled();
            request.nudge_seed = static_cast<std::uint64_t>(n);
            RemeshResult result = child_->remesh(request, options_->limit);
            if (result.status == KERF_REMESH_UNCHANGED) return request.base;
            why = result.status == KERF_OK ? flaw_of_result(request, result.mesh) : result.message;
            if (result.status == KERF_OK && why.empty()) return std::move(result.mesh);
            ++made_->refusals;
            made_->notes.push_back("Attempt " + std::to_string(n + 1) + " was refused: " + why + ".");
            if (!child_->is_running() || result.status == KERF_REMESH_CANCELLED) break;
        }
        made_->error = "no exact surface could be made: " + why + ".";
        return std::nullopt;
    }

    /// One stretch after the other, each in its patch; at the end all of it is checked as one.
    std::optional<TaggedMesh> cut_locally(const RemeshRequest& request) {
        LocalCutting cutting(request.base, request.solids, request.tolerance,
                             [this](const RemeshRequest& patch) { return child_->remesh(patch, options_->limit); });
        for (std::size_t n = 0; n < request.cuts.size(); ++n) {
            if (options_->progress)
                options_->progress(static_cast<double>(n) / static_cast<double>(request.cuts.size()),
                                   "cutting along " + std::to_string(request.cuts.size()) + " straight stretches");
            if (is_cancelled() || !cutting.cut(request.cuts[n])) break;
        }
        if (is_cancelled()) return cancelled();
        made_->refusals += cutting.refusals();
        TaggedMesh mesh = cutting.surface().mesh();
        const std::string flaw = cutting.stale().empty() ? flaw_of_result(request, mesh) : std::string();
        if (cutting.stale().empty() && flaw.empty()) return mesh;
        made_->error = "no exact surface could be made: " +
                       (flaw.empty() ? "a stretch could not be cut: " + cutting.stale().front().why : flaw) + ".";
        return std::nullopt;
    }

    /// Gives a part to the group on whose bodies' surfaces most of it lies; or, for later, to a body of none of them:
    /// the field comes apart a little before the mesh does. A part of a group that is cut further may lie on none of
    /// its bodies with most of its vertices; one that lies on none at all is a crumb.
    void share_out(const Part& part, const std::vector<std::vector<Remains>>& groups, std::size_t common,
                   std::vector<TaggedMesh>& meshes) {
        std::size_t nearest = 0;
        double most = 0.0;
        bool is_beyond_the_field = true;
        for (std::size_t g = 0; g < groups.size(); ++g) {
            const auto on = fraction_on(part, *bone_, *present_, groups[g]);
            if (!on) continue;
            is_beyond_the_field = false;
            if (*on <= most) continue;
            most = *on;
            nearest = g;
        }
        // What the field does not reach was cut by nothing and belongs to what was there first.
        if (is_beyond_the_field || most > 0.5) {
            append(part.mesh, meshes[nearest]);
            return;
        }
        if (const auto other = is_late_ ? std::nullopt : body_under(part)) {
            const auto& records = groups.front().front().records;
            late_.push_back({part.mesh, *other, std::min(common, common_count({{0, records}, bodies_[*other]}))});
            return;
        }
        const bool is_cut_further = groups[nearest].front().records.size() > common;
        if (most > 0.0 && is_cut_further) {
            append(part.mesh, meshes[nearest]);
            return;
        }
        ++made_->crumbs;
        made_->crumb_volume += part.volume;
    }

    /// The number in `bodies_` of the one on which most of a part lies.
    [[nodiscard]] std::optional<std::size_t> body_under(const Part& part) const {
        for (std::size_t n = 0; n < bodies_.size(); ++n)
            if (fraction_on(part, *bone_, *present_, {bodies_[n]}).value_or(0.0) > 0.5) return n;
        return std::nullopt;
    }

    [[nodiscard]] std::size_t number_of(const Remains& one) const {
        return static_cast<std::size_t>(
            std::find_if(bodies_.begin(), bodies_.end(), [&](const Remains& other) { return other.body == one.body; }) -
            bodies_.begin());
    }

    void keep(std::size_t body, TaggedMesh mesh) {
        ExactPiece piece{body, std::move(mesh), 0.0, bone_volume(*bone_, present_->cut(body)), 0.0};
        piece.volume = signed_volume_of(piece.mesh.mesh);
        piece.wall_area = wall_area_of(piece.mesh);
        made_->allowed += 0.15 * bone_->grid().spacing * piece.wall_area;
        if (piece.mesh.mesh.triangles.empty() && piece.field_volume > 0.0)
            made_->notes.push_back("Body " + std::to_string(body) + ", " + text_of(piece.field_volume) +
                                   " in the field, has no part of the mesh.");
        made_->pieces.push_back(std::move(piece));
    }

    [[nodiscard]] bool is_cancelled() const { return options_->is_cancelled && options_->is_cancelled(); }
    std::optional<TaggedMesh> cancelled() {
        made_->error = "interrupted.";
        return std::nullopt;
    }

    const PresentBone* present_;
    RemeshChild* child_;
    const Body* bone_;
    std::vector<Remains> bodies_;
    std::vector<TaggedMesh> meshes_;  ///< of each body: what it has so far
    std::vector<Late> late_;
    bool is_late_ = false;  ///< no part is handed on twice
    const std::vector<const ToolSolid*>* solids_;
    const ExactOptions* options_;
    ExactSurface* made_;
};

}  // namespace

ExactSurface exact_surface(const Scene& scene, const Simulation& simulation, RemeshChild& child,
                           const ExactOptions& options) {
    ExactSurface made;
    const std::vector<const ToolSolid*> solids = cutting_solids(scene);
    for (const auto& [bone, bodies] : remains_of(simulation)) {
        if (options.progress) options.progress(0.0, "reading the uncut surface");
        auto base = base_of(scene, *bone, made);
        if (!base) return made;
        made.base_volume += signed_volume_of(*base);
        made.field_base_volume += bone_volume(*bone, CutField(*bone, 0));
        std::vector<std::uint8_t> tags(base->triangles.size(), KERF_FACE_SURFACE);
        ExactCutting cutting(simulation, child, *bone, bodies, solids, options, made);
        if (!cutting.make_pieces({std::move(*base), std::move(tags)})) return made;
    }
    std::sort(made.pieces.begin(), made.pieces.end(),
              [](const ExactPiece& a, const ExactPiece& b) { return a.body < b.body; });
    made.removed = made.base_volume;
    made.field_removed = made.field_base_volume;
    for (const ExactPiece& piece : made.pieces) {
        made.removed -= piece.volume;
        made.field_removed -= piece.field_volume;
    }
    for (const ExactPiece& piece : made.pieces)
        if (piece.mesh.mesh.triangles.empty() && piece.field_volume > 0.0 && made.error.empty())
            made.error = "body " + std::to_string(piece.body) +
                         " came apart in the field while a bridge was left in the mesh, which no later cut removes.";
    made.removed -= made.crumb_volume;
    if (std::abs(made.removed - made.field_removed) > made.allowed)
        made.notes.push_back("Mesh and field differ by more than the field explains: the mesh lost " +
                             text_of(made.removed) + ", the field " + text_of(made.field_removed) + ".");
    made.digest = digest_of(made.pieces);
    return made;
}

}  // namespace kerf
