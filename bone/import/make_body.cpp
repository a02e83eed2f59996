// SPDX-License-Identifier: Apache-2.0
#include "bone/import/make_body.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bone/import/bone_distances.h"
#include "bone/import/ct_body.h"
#include "bone/import/fields_memory.h"
#include "bone/import/fit_landmarks.h"
#include "bone/import/landmark_checks.h"
#include "bone/import/mesh_body.h"
#include "bone/import/phantom_walls.h"
#include "bone/surface/diagnose.h"
#include "documents/read_anatomy.h"
#include "documents/solids.h"
#include "text/distinguishing_digits.h"

namespace kerf::bone {

namespace {

constexpr double min_fraction_in_bone = 0.80;  // [–] fraction of a planned axis in bone
constexpr double min_wall_voxels = 3.0;        // thickness that one distance field can represent
constexpr double finest_spacing = 0.05e-3;     // [m] smallest spacing of a procedure

using Distance = std::function<double(Vec3)>;  // body frame [m] → [m], negative inside

/// Returns the location in the document that defines the bone.
text::Reason bone_in(const documents::Anatomy& anatomy) {
    return documents::in_anatomy(anatomy, {anatomy.ct ? "ct" : anatomy.mesh ? "mesh" : "phantom"});
}

Box phantom_bounds(const documents::PhantomSource& phantom) {
    Box bounds = empty_box;
    for (const auto& part : phantom.parts) {
        if (part.subtract) continue;
        const Box box = bounds_of(part.solid);
        bounds = joined(bounds, box);
    }
    return bounds;
}

/// Returns the added parts, or the subtracted ones as if they were added.
std::vector<documents::PhantomPart> parts_of(const documents::PhantomSource& phantom, bool subtract) {
    std::vector<documents::PhantomPart> parts;
    for (const auto& part : phantom.parts)
        if (part.subtract == subtract) parts.emplace_back(part).subtract = false;
    return parts;
}

/// Returns whether parts are subtracted without a fillet, and none is added after them. Then bone is all added parts
/// less all subtracted ones.
bool subtracts_last(const documents::PhantomSource& phantom) {
    return !phantom.parts.empty() && phantom.parts.back().subtract &&
           std::none_of(phantom.parts.begin(), phantom.parts.end(),
                        [](const documents::PhantomPart& p) { return p.subtract && p.blend > 0.0; }) &&
           std::is_partitioned(phantom.parts.begin(), phantom.parts.end(),
                               [](const documents::PhantomPart& p) { return !p.subtract; });
}

/// Returns whether bone between the outside and a cavity is somewhere too thin for one field. Where a cavity opens to
/// the outside, both surfaces cross at an edge. So only surfaces with the same orientation count as a wall.
bool has_thin_wall(const Grid& grid, DistanceSource& outer, DistanceSource& cavity) {
    constexpr double same_direction = 0.8;  // [–] cosine
    const double thin = min_wall_voxels * grid.spacing, in_brick = 0.5 * brick_edge * std::sqrt(3.0) * grid.spacing;
    const auto gradient = [&](DistanceSource& source, Vec3 p) {
        const double d = 0.25 * grid.spacing;
        const auto distance = as_function(source);
        return normalized(Vec3{distance(p + Vec3{d, 0, 0}) - distance(p - Vec3{d, 0, 0}),
                               distance(p + Vec3{0, d, 0}) - distance(p - Vec3{0, d, 0}),
                               distance(p + Vec3{0, 0, d}) - distance(p - Vec3{0, 0, d})});
    };
    const auto within = [](double most) { return DistanceRange{-most, most}; };
    const auto is_thin_at = [&](Vec3 p) {
        const double to_outer = outer.at(p, within(thin));
        if (std::abs(to_outer) > thin) return false;
        const double thickness = cavity.at(p, within(2.0 * thin)) - to_outer;
        return thickness > 0.0 && thickness < thin && dot(gradient(outer, p), gradient(cavity, p)) > same_direction;
    };
    for (int k = 0; k < grid.bricks[2]; ++k)
        for (int j = 0; j < grid.bricks[1]; ++j)
            for (int i = 0; i < grid.bricks[0]; ++i) {
                const double half = 0.5 * brick_edge * grid.spacing;
                const Vec3 centre =
                    grid.sample_position(i * brick_edge, j * brick_edge, k * brick_edge) + Vec3{half, half, half};
                const double near_outer = in_brick + thin, near_cavity = in_brick + 2.0 * thin;
                if (std::abs(outer.at(centre, within(near_outer))) > near_outer ||
                    std::abs(cavity.at(centre, within(near_cavity))) > near_cavity)
                    continue;
                for (int n = 0; n < brick_edge * brick_edge * brick_edge; ++n)
                    if (is_thin_at(grid.sample_position(i * brick_edge + n % brick_edge,
                                                        j * brick_edge + n / brick_edge % brick_edge,
                                                        k * brick_edge + n / (brick_edge * brick_edge))))
                        return true;
            }
    return false;
}

/// Returns the largest box whose faces lie on samples of the grid.
Region region_on(const Grid& grid, const Box& box) {
    const auto up = [&](double at, double origin) {
        return static_cast<int>(std::ceil((at - origin) / grid.spacing - 1e-6));
    };
    const auto down = [&](double at, double origin) {
        return static_cast<int>(std::floor((at - origin) / grid.spacing + 1e-6));
    };
    return {
        grid.sample_position(up(box.low.x, grid.origin.x), up(box.low.y, grid.origin.y), up(box.low.z, grid.origin.z)),
        grid.sample_position(down(box.high.x, grid.origin.x), down(box.high.y, grid.origin.y),
                             down(box.high.z, grid.origin.z))};
}

/// Returns whether the base tissue may be in a brick: it has bone, and no shell so far fills it.
bool may_hold_base(const Body& body, std::size_t brick) {
    return !body.surface.is_all_air(brick) &&
           std::none_of(body.materials.begin(), body.materials.end(),
                        [&](const Material& shell) { return shell.border.is_all_solid(brick); });
}

ImportReport phantom_report(const documents::Anatomy& anatomy) {
    ImportReport report;
    report.notes = {"Phantom: " + std::to_string(anatomy.phantom.parts.size()) + " solids; no scan was read."};
    return report;
}

/// Returns a phantom for fits. It contains no bone if the bone is made from a scan or a surface.
BoneShape phantom_shape(const documents::Anatomy& anatomy) {
    return {[&](Vec3 p) { return distance_to(anatomy.phantom, p); },
            {{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, HUGE_VAL, HUGE_VAL}}};
}

/// Checks thin walls. One distance field can represent a wall of three voxels; thinner ones are too weak or missing. So
/// a plate with air on both sides is refused. A spur, or two faces that touch, must not demand the finest spacing: the
/// limit applies to all walls except a thousandth of their area.
bool check_thin_walls(const std::vector<WallSample>& walls, double spacing, const documents::Anatomy& anatomy,
                      text::Diagnostics& diagnostics) {
    const double needed = min_wall_voxels * spacing;
    const auto smallest = thinnest(walls);
    if (!smallest || smallest->thickness >= needed) return true;
    const text::Reason file = anatomy.mesh ? documents::in_anatomy(anatomy, {"mesh", "file"})
                                           : documents::in_anatomy(anatomy, {"phantom", "parts"});
    const std::string thin =
        "the bone is only " + rounded(smallest->thickness * 1e3, 2) + " mm thick at " + position_text(smallest->at);
    const double carried = thickness_at(walls, 1e-3);
    if (carried >= needed) {
        diagnostics.push_back(text::warning_at(
            file, "W0658",
            thin + ", on under 0.1 % of its surface here: too little for the " + rounded(needed * 1e3, 2) +
                " mm that a spacing of " + rounded(spacing * 1e3, 3) + " mm can carry. There it is felt too weakly."));
        return true;
    }
    const double fine_enough = std::floor(carried / min_wall_voxels * 1e5) * 1e-5;  // to 0.01 mm
    const bool can_be_carried = fine_enough >= finest_spacing;
    text::Diagnostic plate = text::error_at(
        file, "E0655",
        thin + ", with air on both sides, and " + rounded(100.0 * fraction_under(walls, needed), 1) +
            " % of its surface here is thinner than the " + rounded(needed * 1e3, 2) + " mm that a spacing of " +
            rounded(spacing * 1e3, 3) + " mm can carry." +
            (can_be_carried ? "" : " No spacing carries that. Make it thicker there, or plan where it is."));
    if (can_be_carried) plate.write = "accuracy: {spacing: " + rounded(fine_enough * 1e3, 2) + " mm}";
    diagnostics.push_back(std::move(plate));
    return false;
}

/// Refuses a bone that needs more memory than the limit, or more bricks than can be counted. The message names a
/// spacing that fits.
bool check_memory(const Box& bounds, double spacing, const std::vector<Distance>& borders, bool has_densities,
                  const documents::Anatomy& anatomy, text::Diagnostics& diagnostics) {
    const FieldsMemory needed = fields_memory(bounds, spacing, borders, has_densities);
    if (excess_of(needed) <= 1.0) return true;
    double fits = spacing * std::max(1.0, std::cbrt(needed.bricks / 16e6));
    while (excess_of(fields_memory(bounds, fits, borders, has_densities)) >
           0.9 /* the estimate is a few per cent off */)
        fits *= 1.1;
    const Vec3 extent = bounds.high - bounds.low;
    const bool is_memory = needed.bytes > max_bone_memory;
    const text::ComparedTexts memory = text::compared(needed.bytes / max_bone_memory * 4.0, 4.0, 0, 6, &rounded);
    text::Diagnostic large = text::error_at(
        bone_in(anatomy), "E0602",
        "a bone of " + rounded(extent.x * 1e3, 0) + " × " + rounded(extent.y * 1e3, 0) + " × " +
            rounded(extent.z * 1e3, 0) + " mm at a spacing of " + rounded(spacing * 1e3, 3) + " mm takes about " +
            (is_memory ? memory.value + " GB of memory, must be at most " + memory.bound + " GB."
                       : rounded(needed.bricks * 1e-6, 1) + " million bricks of 8³ samples, " +
                             rounded(needed.cuttable * 1e-6, 1) +
                             " million of them bone; must be at most 16 million, and 2.9 million.") +
            " Use a coarser spacing, or a smaller bone: of a scan or a surface only what lies around the axes is "
            "kept.");
    large.write = "accuracy: {spacing: " + rounded(std::ceil(fits * 1e5) * 1e-2, 2) + " mm}";
    diagnostics.push_back(std::move(large));
    return false;
}

/// A source that reports progress for every hundredth of the grid's height. Its callers process the grid layer by
/// layer, some of them twice.
class ProgressSource final : public DistanceSource {
public:
    ProgressSource(DistanceSource& distance, const Grid& grid, const Progress& progress, std::string what)
        : distance_(&distance),
          progress_(&progress),
          what_(std::move(what)),
          low_(grid.origin),
          depth_(grid.spacing * brick_edge * grid.bricks[1]),
          height_(grid.spacing * brick_edge * grid.bricks[2]) {}
    [[nodiscard]] double at(Vec3 p, DistanceRange needed) override {
        report_progress(p.z);
        return distance_->at(p, needed);
    }
    void fill(const BrickLattice& lattice, DistanceRange needed, BrickDistances distances) override {
        const double fraction_of_layer = (lattice.y.front() - low_.y) / depth_;
        report_progress(lattice.z.front() + fraction_of_layer * (lattice.z.back() - lattice.z.front()));
        distance_->fill(lattice, needed, distances);
    }

private:
    void report_progress(double z) {
        if (!*progress_) return;
        const int hundredth = std::clamp(static_cast<int>(100.0 * (z - low_.z) / height_), 0, 100);
        if (hundredth > reported_ || hundredth + 50 < reported_ /* begun anew */)
            (*progress_)(0.01 * (reported_ = hundredth), what_);
    }

    DistanceSource* distance_;
    const Progress* progress_;
    std::string what_;
    Vec3 low_;
    double depth_, height_;
    int reported_ = -1;
};

void note_tissues_and_axes(const documents::Anatomy& anatomy, const Body& body, ImportReport& report) {
    for (const documents::Tissue& tissue : anatomy.tissues) {
        const bool is_base = &tissue == &anatomy.tissues.back();
        const Material& material = body.materials[static_cast<std::size_t>(&tissue - anatomy.tissues.data())];
        std::string note = "Tissue " + tissue.id + ": ";
        if (is_base) note += "what the others leave";
        if (tissue.thickness > 0.0) {
            const std::string min = rounded(thinnest(tissue) * 1e3, 2), max = rounded(thickest(tissue) * 1e3, 2);
            note += (min == max ? max : min + " to " + max) + " mm, prescribed, not measured";
        }
        if (!tissue.solids.empty())
            note += (tissue.thickness > 0.0 ? ", within " : "within ") + std::to_string(tissue.solids.size()) +
                    (tissue.solids.size() == 1 ? " solid" : " solids");
        note += material.densities.is_empty() ? "; " + rounded(material.density * 1e-3, 2) + " g/cm3 everywhere."
                                              : "; density by place.";
        report.notes.push_back(std::move(note));
    }
    for (const documents::LandmarkAxis& axis : anatomy.axes) {
        const AxisInBone found = axis_in_bone(body, axis);
        report.notes.push_back("Axis " + axis.id + ": " +
                               (found.entry < 0.0
                                    ? "meets no bone."
                                    : "meets bone after " + rounded(found.entry * 1e3, 1) + " mm; " +
                                          rounded(100.0 * found.share, 0) + " % of the rest lies in bone."));
    }
}

/// The distances of a bone that is made of a scan, a surface or a phantom. Borders refer to it, so it stays where it
/// is.
class BoneDistances {
public:
    /// All must live longer. The region may change. At most one of `ct` and `mesh` is given.
    BoneDistances(const documents::Anatomy& anatomy, const CtBone* ct, const MeshBone* mesh, double spacing,
                  const Region& region) {
        if (mesh) {
            surface_tree_.emplace(mesh->surface);
            for (const SurfaceMesh& one : mesh->inner_surfaces) room_trees_.emplace_back(one);
        }
        const documents::PhantomSource& phantom = anatomy.phantom;
        has_rooms_ = !room_trees_.empty() || subtracts_last(phantom);
        if (ct)
            source_ = std::make_unique<FunctionDistance>(
                [ct, spacing](Vec3 p) { return ct->distance.sample_trilinear(p, spacing * 1e3); });
        else if (mesh)
            source_ = std::make_unique<MeshDistances>(*surface_tree_);
        else if (has_rooms_)
            source_ = std::make_unique<PhantomDistance>(parts_of(phantom, false));
        else
            source_ = std::make_unique<PhantomDistance>(phantom.parts);
        if (!room_trees_.empty())
            source_of_rooms_ =
                std::make_unique<NearestSurface>(std::vector<MeshDistances>(room_trees_.begin(), room_trees_.end()));
        else
            source_of_rooms_ = std::make_unique<PhantomDistance>(parts_of(phantom, true));
        // Beyond the region that was read, bone continues as it is at the region's face.
        outer_in_region_.emplace(*source_, region);
        rooms_in_region_.emplace(*source_of_rooms_, region);
        const DistanceRange needed = needed_range(anatomy, clamp_voxels * spacing);
        outer_.emplace(*outer_in_region_, needed);
        rooms_.emplace(*rooms_in_region_, needed.negated());
        without_rooms_.emplace(*outer_, *rooms_);
        DistanceSource& face =
            mesh ? *outer_ : bone();  // a surface's shell lies under its outside, not around the canal
        for (const documents::Tissue& tissue : anatomy.tissues)
            if (&tissue != &anatomy.tissues.back()) tissue_borders_.emplace_back(face, tissue);
    }
    BoneDistances(const BoneDistances&) = delete;
    BoneDistances& operator=(const BoneDistances&) = delete;

    [[nodiscard]] bool has_cavities() const noexcept { return has_rooms_; }
    [[nodiscard]] DistanceSource& outer() noexcept { return *outer_; }
    [[nodiscard]] DistanceSource& inner_surfaces() noexcept { return *rooms_; }
    [[nodiscard]] DistanceSource& bone() noexcept {
        return has_rooms_ ? static_cast<DistanceSource&>(*without_rooms_) : *outer_;
    }
    /// `tissue` is an index; the last tissue has no border of its own.
    [[nodiscard]] DistanceSource& border(std::size_t tissue) noexcept { return tissue_borders_[tissue]; }

    /// Of the bone, its rooms and its tissues.
    [[nodiscard]] std::vector<Distance> borders() {
        std::vector<Distance> all{as_function(bone())};
        if (has_rooms_) all.push_back(as_function(*rooms_));
        for (TissueBorder& border : tissue_borders_) all.push_back(as_function(border));
        return all;
    }

private:
    /// Returns the distances to the bone that its surface and the borders of its tissues need.
    static DistanceRange needed_range(const documents::Anatomy& anatomy, double clamp) {
        double deepest = 0.0;
        for (const documents::Tissue& tissue : anatomy.tissues)
            if (&tissue != &anatomy.tissues.back()) deepest = std::max(deepest, documents::thickest(tissue));
        return {-(deepest + clamp), clamp};
    }

    std::optional<TriangleTree> surface_tree_;
    std::vector<TriangleTree> room_trees_;
    bool has_rooms_ = false;
    std::unique_ptr<DistanceSource> source_, source_of_rooms_;
    std::optional<InRegion> outer_in_region_, rooms_in_region_;
    std::optional<RememberedBrick> outer_, rooms_;
    std::optional<WithoutCavities> without_rooms_;
    std::vector<TissueBorder> tissue_borders_;
};

/// Samples the density of a material [kg/m³] in the bricks that may hold it.
void set_densities(const Body& body, const std::function<bool(std::size_t)>& may_hold,
                   const std::function<double(Vec3)>& density, Material& material) {
    material.densities = DensityField::build(body.grid(), may_hold, density);
    if (!material.densities.is_empty()) material.density = material.densities.largest();
}

/// Sets the density of the last tissue by the scan's grey values.
void set_scan_density(const CtBone& ct, const documents::DensityLine& line, const Body& body, Material& material) {
    material.density = std::max(line.floor, line.at_zero + line.per_unit * ct.mean_value);
    if (!ct.density) return;
    const double elsewhere = material.density;
    set_densities(
        body, [&](std::size_t brick) { return may_hold_base(body, brick); },
        [&](Vec3 p) { return ct.density->sample_trilinear(body.region.nearest(p), elsewhere); }, material);
}

bool varies_in_density(const documents::Tissue& tissue) {
    return std::any_of(tissue.regions.begin(), tissue.regions.end(),
                       [](const documents::TissueRegion& region) { return region.density > 0.0; });
}

/// Sets the density of a tissue by its regions.
void set_region_density(const documents::Tissue& tissue, bool is_base, const Body& body, Material& material) {
    const auto may_hold = [&](std::size_t brick) {
        return is_base ? may_hold_base(body, brick)
                       : !body.surface.is_all_air(brick) && !material.border.is_all_air(brick);
    };
    set_densities(
        body, may_hold, [&](Vec3 p) { return documents::density_at(tissue, p); }, material);
}

constexpr const char* sheet_note =
    "Between the outside and a room in it the bone is thinner than three voxels: each side has a field of its own. "
    "Under one voxel, volumes and the exported surface lose it.";

}  // namespace

text::Result<Body> make_body(const documents::Anatomy& written, double spacing, ImportReport* report,
                             const ImportOptions& options) {
    text::Diagnostics diagnostics;
    std::optional<CtBone> ct;
    if (written.ct && !(ct = make_ct_bone(written, options).take(diagnostics))) return diagnostics;
    std::optional<MeshBone> mesh;
    if (written.mesh && !(mesh = make_mesh_bone(written).take(diagnostics))) return diagnostics;
    ImportReport made = ct ? std::move(ct->report) : mesh ? std::move(mesh->report) : phantom_report(written);
    documents::Anatomy anatomy = written;
    use_fits(anatomy, made);
    if (!fit_landmarks(anatomy, phantom_shape(anatomy), made, diagnostics)) return diagnostics;

    const Box bounds = ct ? ct->region : mesh ? mesh->region : phantom_bounds(anatomy.phantom);
    if (!is_finite(bounds.low) || !is_finite(bounds.high)) {
        diagnostics.push_back(text::error_at(
            documents::in_anatomy(anatomy, {"phantom", "parts"}), "E0601",
            "the phantom has no part that adds bone. Give `phantom.parts` at least one part without `subtract`."));
        return diagnostics;
    }
    if (mesh && !check_thin_walls(mesh->walls, spacing, anatomy, diagnostics)) return diagnostics;

    Body body;
    body.id = anatomy.id;
    const bool is_part = ct || (mesh && mesh->is_part);
    if (is_part) body.region = {bounds.low, bounds.high};
    BoneDistances distances(anatomy, ct ? &*ct : nullptr, mesh ? &*mesh : nullptr, spacing, body.region);
    const bool has_scan_densities = ct && anatomy.ct->density;
    const bool has_densities =
        has_scan_densities || std::any_of(anatomy.tissues.begin(), anatomy.tissues.end(), varies_in_density);
    if (!check_memory(bounds, spacing, distances.borders(), has_densities, anatomy, diagnostics)) return diagnostics;

    const double margin = 6.0 * spacing;
    const Vec3 around{margin, margin, margin};
    const Grid grid = Grid::covering(bounds.low - around, bounds.high + around, spacing);
    if (is_part) body.region = region_on(grid, bounds);
    const auto reporting = [&](DistanceSource& distance, const std::string& what) {
        return ProgressSource(distance, grid, options.progress, what);
    };
    ProgressSource outer_for_walls = reporting(distances.outer(), "how thick its walls are");
    const bool has_sheet = distances.has_cavities() && has_thin_wall(grid, outer_for_walls, distances.inner_surfaces());
    ProgressSource outside =
        reporting(has_sheet ? distances.outer() : distances.bone(),
                  anatomy.tissues.size() > 1 ? "distances to its surface and tissues" : "distances to its surface");
    std::vector<DistanceSource*> sources{&outside};
    for (std::size_t n = 0; n + 1 < anatomy.tissues.size(); ++n) sources.push_back(&distances.border(n));
    if (has_sheet) sources.push_back(&distances.inner_surfaces());
    std::vector<LevelSet> fields = LevelSet::build(grid, sources);
    if (has_sheet) body.hollow = std::move(fields.back());
    body.surface = std::move(fields.front());
    if (!ct && !mesh) {
        DistanceSource& exact = has_sheet ? distances.outer() : distances.bone();
        const double most = (min_wall_voxels + 1.0) * spacing;
        if (!check_thin_walls(phantom_walls(body.surface, exact, most), spacing, anatomy, diagnostics))
            return diagnostics;
    }
    for (const auto& tissue : anatomy.tissues) {
        Material material{tissue.id, tissue.density, {}};
        const bool is_base = &tissue == &anatomy.tissues.back();
        if (is_base && has_scan_densities) set_scan_density(*ct, *anatomy.ct->density, body, material);
        if (!is_base) material.border = std::move(fields[body.materials.size() + 1]);
        if (varies_in_density(tissue)) set_region_density(tissue, is_base, body, material);
        body.materials.push_back(std::move(material));
    }
    check_landmarks(anatomy, body, diagnostics);
    if (report) {
        *report = std::move(made);
        if (has_sheet) report->notes.emplace_back(sheet_note);
        note_tissues_and_axes(anatomy, body, *report);
    }
    return {std::move(body), std::move(diagnostics)};
}

AxisInBone axis_in_bone(const Body& body, const documents::LandmarkAxis& axis) {
    constexpr int max_steps_back = 10000;
    constexpr double min_reversed_depth = 5e-3;  // [m] an axis that begins less deep starts too far in
    const double step = 0.1 * body.grid().spacing;
    const Vec3 along = normalized(axis.to - axis.from);
    const int steps = static_cast<int>(length(axis.to - axis.from) / step);
    const auto is_bone_at = [&](int i) {
        return uncut_distance(body, locate(body.grid(), axis.from + i * step * along)) < 0.0;
    };
    AxisInBone found{-1.0, 0.0};
    int inside = 0, behind = 0, last = 0;
    for (int i = 0; i <= steps; ++i) {
        const bool is_bone = is_bone_at(i);
        if (found.entry < 0.0 && is_bone) found.entry = i * step;
        if (found.entry < 0.0) continue;
        ++behind;
        inside += is_bone;
        if (is_bone) last = i;
    }
    if (behind > 0) found.share = static_cast<double>(inside) / behind;
    for (int i = 0; i > -max_steps_back && is_bone_at(i); --i) found.inside = (1 - i) * step;
    const bool is_in_bone_to_the_last = inside >= min_fraction_in_bone * (last + 1);
    found.is_reversed = found.inside > min_reversed_depth && last < steps && is_in_bone_to_the_last;
    return found;
}

Vec3 into_surface(const Body& body, Vec3 point) {
    constexpr double reach = 1.2e-3;  // [m] radius of a drill
    const double step = body.grid().spacing;
    const int most = static_cast<int>(reach / step);
    const auto distance = [&](Vec3 at) { return uncut_distance(body, locate(body.grid(), at)); };
    Vec3 outwards{};
    for (int i = -most; i <= most; ++i)
        for (int j = -most; j <= most; ++j)
            for (int k = -most; k <= most; ++k) {
                const Vec3 at =
                    point + step * Vec3{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
                if (length(at - point) > reach || std::abs(distance(at)) > step) continue;
                outwards = outwards + Vec3{distance(at + Vec3{step, 0, 0}) - distance(at - Vec3{step, 0, 0}),
                                           distance(at + Vec3{0, step, 0}) - distance(at - Vec3{0, step, 0}),
                                           distance(at + Vec3{0, 0, step}) - distance(at - Vec3{0, 0, step})};
            }
    return length(outwards) > 0.0 ? -normalized(outwards) : Vec3{};
}

void check_axis(const documents::Anatomy& anatomy, const documents::LandmarkAxis& axis, const AxisInBone& found,
                text::Diagnostics& diagnostics) {
    const auto at = [&] { return documents::in_anatomy(anatomy, {"landmarks", "axes", axis.id}); };
    if (found.entry < 0.0)
        diagnostics.push_back(
            text::error_at(at(), "E0610",
                           "the axis `" + axis.id +
                               "` meets no bone. Check its points: LPS, millimetres, from outside into the bone."));
    else if (found.is_reversed)
        diagnostics.push_back(text::error_at(at(), "E0607",
                                             "the axis `" + axis.id + "` leads out of the bone: `from` lies " +
                                                 rounded(found.inside * 1e3, 1) +
                                                 " mm deep in the bone, and `to` outside. Exchange the two."));
    else if (found.begins_inside())
        diagnostics.push_back(text::error_at(at(), "E0607",
                                             "the axis `" + axis.id + "` begins " + rounded(found.inside * 1e3, 1) +
                                                 " mm inside the bone, so depths do not count from its surface. Move "
                                                 "`from` back along the axis, in front "
                                                 "of the bone."));
    else if (found.share < min_fraction_in_bone) {
        const double fraction = 100.0 * found.share, need = 100.0 * min_fraction_in_bone;
        const text::ComparedTexts shown = text::compared(fraction, need, 0, 6, &rounded);
        diagnostics.push_back(text::error_at(at(), "E0611",
                                             "the axis `" + axis.id + "` lies in bone for only " + shown.value +
                                                 " % of its length behind the entry, need " + shown.bound +
                                                 " %. Check its points, or the tissues of the anatomy."));
    }
}

}  // namespace kerf::bone
