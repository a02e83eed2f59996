// SPDX-License-Identifier: Apache-2.0
#include "bone/exact/exact_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bone/exact/base_surface.h"
#include "bone/report/import_report.h"
#include "bone/surface/surface_mesh.h"
#include "core/field/cut/removed_volume.h"
#include "core/field/fnv1a.h"

namespace kerf::bone {
namespace {

std::string text_of(double volume) { return rounded(volume * 1e9, 1) + " mm3"; }

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

std::vector<ExactBody> bodies_of(const ExactState& state, const Body& bone) {
    std::vector<ExactBody> bodies;
    std::copy_if(state.bodies.begin(), state.bodies.end(), std::back_inserter(bodies),
                 [&](const ExactBody& one) { return one.bone == &bone; });
    return bodies;
}

ExactPiece piece_of(const ExactBody& body, TaggedMesh mesh) {
    ExactPiece piece{body.body, std::move(mesh), 0.0, bone_volume(*body.bone, *body.cut), {}};
    piece.volume = signed_volume_of(piece.mesh.mesh);
    const std::vector<double> areas = wall_areas_of(piece.mesh, *body.bone);
    for (std::size_t m = 0; m < areas.size(); ++m) piece.wall_areas.emplace_back(body.bone->materials[m].id, areas[m]);
    return piece;
}

/// Returns the largest tolerance of the strategies [m], less the request's own.
double stated_tolerance(const ExactTools& tools) {
    double largest = tools.tolerance;
    for (const auto& strategies : tools.strategies)
        for (const ExactStrategy& one : strategies) largest = std::max(largest, one.child->tolerance());
    return largest - tools.tolerance;
}

double wall_area_of(const ExactPiece& piece) {
    double sum = 0.0;
    for (const auto& [tissue, area] : piece.wall_areas) sum += area;
    return sum;
}

}  // namespace

ExactState exact_state(const Simulation& simulation, bool with_cuts) {
    ExactState state{{}, !simulation.is_in_a_cut()};
    const PresentBone& present = simulation.present();
    for (std::size_t body = 0; body < present.count(); ++body) {
        // The scene has a newly separated part before the loop takes it over.
        const auto& live = simulation.bodies();
        const bool is_known = body < live.size();
        if (is_known && !live[body]->is_cuttable) continue;
        const PresentPiece& piece = present.piece(body);
        state.bodies.push_back({body, piece.separated_from, piece.bone, !is_known || live[body]->is_present,
                                piece.history, with_cuts ? std::make_shared<const CutField>(piece.cut) : nullptr});
    }
    return state;
}

ExactSurfaces::ExactSurfaces(ExactTools tools) : tools_(std::move(tools)) {}

ExactSurfaces::Bone& ExactSurfaces::bone(const Body& field) {
    const auto known = std::find_if(bones_.begin(), bones_.end(), [&](const Bone& one) { return one.field == &field; });
    if (known != bones_.end()) return *known;
    tools_.report(0.0, "reading the uncut surface");
    Bone& made = bones_.emplace_back(Bone{&field, nullptr, {}, {}});
    const documents::Anatomy* own = &field == tools_.meshed ? tools_.anatomy : nullptr;
    if (auto base = base_surface(own, field, made.notes, made.error))
        made.surface = std::make_unique<ExactBone>(field, tagged(std::move(*base)), tools_);
    return made;
}

void ExactSurfaces::follow(const ExactState& state) {
    std::vector<const Body*> fields;
    for (const ExactBody& one : state.bodies)
        if (std::find(fields.begin(), fields.end(), one.bone) == fields.end()) fields.push_back(one.bone);
    for (const Body* field : fields)
        if (const Bone& one = bone(*field); one.surface != nullptr)
            one.surface->follow(bodies_of(state, *field), state.may_return);
}

ExactSurface ExactSurfaces::finish(const ExactState& state) {
    follow(state);
    ExactSurface made;
    double by_tolerance = 0.0;  // [m³]
    made.notes = tools_.notes;
    for (const Bone& one : bones_) {
        const std::vector<ExactBody> bodies = bodies_of(state, *one.field);
        if (bodies.empty()) continue;
        made.notes.insert(made.notes.end(), one.notes.begin(), one.notes.end());
        if (made.error.empty()) made.error = one.error;
        if (one.surface == nullptr) continue;
        made.base_volume += one.surface->uncut_volume();
        const double field_base = bone_volume(*one.field, CutField(*one.field, 0));
        made.field_base_volume += field_base;
        std::vector<TaggedMesh> meshes = one.surface->finish(bodies);
        if (const auto stale = one.surface->stale(); !stale.empty() && made.error.empty())
            made.error =
                "no exact surface could be made of `" + one.field->id + "`: " + stale.front().why +
                (stale.size() > 1 ? "; " + std::to_string(stale.size() - 1) + " more of its cuts are missing." : ".");
        made.removed += one.surface->uncut_volume() - one.surface->crumb_volume();
        made.field_removed += field_base;
        for (std::size_t n = 0; n < bodies.size(); ++n) {
            ExactPiece piece = piece_of(bodies[n], std::move(meshes[n]));
            made.removed -= piece.volume;
            made.field_removed -= piece.field_volume;
            made.allowed += 0.15 * one.field->grid().spacing * wall_area_of(piece);
            by_tolerance += stated_tolerance(tools_) * wall_area_of(piece);
            if (piece.mesh.mesh.triangles.empty() && piece.field_volume > 0.0 && made.error.empty())
                made.error =
                    "body " + std::to_string(piece.body) +
                    " came apart in the field while a bridge was left in the mesh, which no later cut removes.";
            if (bodies[n].is_present) made.pieces.push_back(std::move(piece));
        }
        made.records += one.surface->records();
        made.stretches += one.surface->stretches();
        made.crumbs += one.surface->crumbs();
        made.crumb_volume += one.surface->crumb_volume();
        made.refusals += one.surface->refusals();
        made.handed_over += one.surface->handed_over();
        const std::vector<std::string> notes = one.surface->notes();
        made.notes.insert(made.notes.end(), notes.begin(), notes.end());
    }
    std::sort(made.pieces.begin(), made.pieces.end(),
              [](const ExactPiece& a, const ExactPiece& b) { return a.body < b.body; });
    // A tolerance applies to edges. Even a large one must not hide bone that was not removed.
    made.allowed += std::min(by_tolerance, tools_.volume_accuracy * std::abs(made.field_removed));
    if (made.error.empty() && std::abs(made.removed - made.field_removed) > made.allowed)
        made.error = "the mesh lost " + text_of(made.removed) + " and the field " + text_of(made.field_removed) +
                     ", which differ by more than the " + text_of(made.allowed) +
                     " that the field's grid, the strategies' tolerance and `accuracy: volume` explain.";
    made.digest = digest_of(made.pieces);
    return made;
}

std::vector<std::pair<std::size_t, LocalCutting::Moment>> ExactSurfaces::shown() {
    std::vector<std::pair<std::size_t, LocalCutting::Moment>> all;
    for (const Bone& one : bones_)
        if (one.surface != nullptr)
            for (auto& piece : one.surface->shown()) all.push_back(std::move(piece));
    return all;
}

ExactSurface exact_surface(const Simulation& simulation, ExactTools tools) {
    return ExactSurfaces(std::move(tools)).finish(exact_state(simulation, true));
}

}  // namespace kerf::bone
