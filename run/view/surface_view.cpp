// SPDX-License-Identifier: Apache-2.0
#include "run/view/surface_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace kerf::run {

namespace {

/// A distance along the normal [voxels], and its weight. A stored distance ends at `clamp_voxels`.
struct Probe {
    double distance, weight;
};
constexpr std::array<Probe, 4> probes{{{0.8, 1.0}, {2.0, 0.75}, {4.0, 0.5}, {7.0, 0.4}}};

/// Returns the light at a point of the surface: 1 above a plane and on a ridge, less in a hollow.
double light_at(Vec3 point, Vec3 normal, const Body& bone, const CutField& cut) {
    const double h = bone.grid().spacing;
    double shade = 0.0, sum = 0.0;
    for (const Probe& probe : probes) {
        const LocatedPoint at = locate(bone.grid(), point + probe.distance * h * normal);
        const double open = std::max(bone.surface.at(at), cut.at(at)) / h;
        const double expected = std::min(probe.distance, clamp_voxels);
        shade += probe.weight * std::clamp(1.0 - open / expected, 0.0, 1.0);
        sum += probe.weight;
    }
    return 1.0 - shade / sum;
}

std::int8_t in_127ths(float part) {
    return static_cast<std::int8_t>(std::lround(127.0f * std::clamp(part, -1.0f, 1.0f)));
}

}  // namespace

ViewedPatch lit_patch(const BrickPatch& patch, const Body& bone, const CutField& cut) {
    ViewedPatch viewed;
    const std::size_t count = patch.vertices().size();
    viewed.vertices.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const SurfaceVertex& from = patch.vertices()[i];
        const Vec3 point{from.position[0], from.position[1], from.position[2]};
        const Vec3 normal{from.normal[0], from.normal[1], from.normal[2]};
        ViewedVertex vertex{};
        std::copy_n(from.position, 3, vertex.position);
        std::transform(from.normal, from.normal + 3, vertex.normal, in_127ths);
        vertex.tissue = patch.tissue()[i];
        vertex.light = static_cast<std::uint8_t>(std::lround(255.0 * light_at(point, normal, bone, cut)));
        viewed.vertices.push_back(vertex);
    }
    viewed.triangles = patch.triangles();
    return viewed;
}

std::shared_ptr<const ViewedSurface> SurfaceView::update(PresentBone& bone, const std::vector<bool>& is_drawn) {
    auto next = std::make_shared<ViewedSurface>();
    if (last_ != nullptr) *next = *last_;
    bool has_changed = last_ == nullptr || next->bodies.size() != bone.count();
    while (next->bodies.size() > bone.count()) next->bodies.pop_back();
    pieces_.resize(bone.count());
    for (std::size_t body = 0; body < bone.count(); ++body) {
        const Body& whole = *bone.piece(body).bone;
        if (pieces_[body] && pieces_[body]->bone != &whole) pieces_[body].reset();
        const bool is_new = !pieces_[body];
        if (next->bodies.size() <= body) next->bodies.emplace_back();
        if (is_new) {
            const Grid& grid = whole.grid();
            next->bodies[body] = {grid.bricks, grid.spacing, grid.origin,
                                  PagedTable<ViewedPatch>(is_drawn[body] ? grid.brick_count() : 0)};
            pieces_[body].emplace(Piece{&whole, std::nullopt});
            if (is_drawn[body]) pieces_[body]->patches.emplace(whole);
            has_changed = true;
        }
        if (pieces_[body]->patches && update_body(bone, body, is_new, *next)) has_changed = true;
    }
    if (!has_changed) return nullptr;
    ++next->version;
    last_ = next;
    return next;
}

bool SurfaceView::update_body(PresentBone& bone, std::size_t body, bool is_new, ViewedSurface& next) {
    const std::vector<std::size_t> changed = bone.take_changed(body);
    const CutField& cut = bone.cut(body);
    SurfacePatches& patches = *pieces_[body]->patches;
    const auto published = is_new ? patches.update_all(cut) : patches.update(cut, changed);
    std::vector<PatchChange<ViewedPatch>> lit;
    for (const auto& [brick, patch] : published)
        lit.push_back({brick, patch == nullptr
                                  ? nullptr
                                  : std::make_shared<const ViewedPatch>(lit_patch(*patch, *pieces_[body]->bone, cut))});
    if (lit.empty()) return false;
    next.bodies[body].patches = next.bodies[body].patches.with(lit);
    return true;
}

}  // namespace kerf::run
