// SPDX-License-Identifier: Apache-2.0
#include "bone/import/label_fit.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "bone/import/import_error.h"
#include "bone/report/import_report.h"
#include "documents/read_anatomy.h"

namespace kerf::bone {
namespace {

constexpr std::size_t min_faces = 50;        // fewer are chance
constexpr double good_fit = 0.8;             // [–]
constexpr double bad_fit = 0.7;              // [–]
constexpr double better_by = 0.15;           // [–] fit that a mirror image or a shift must gain
constexpr double better_nearby = 0.05;       // [–] the same for one or two voxels
constexpr float air = -300.0f;               // [HU] darker than fat
constexpr double max_air = 0.2;              // [–] of labels that fit badly
constexpr double max_cut = 20e-6;            // [m²] a label map cut to its structure touches the bone in a few voxels
constexpr double farthest_shift = 30e-3;     // [m]
constexpr std::size_t max_compared = 20000;  // faces in the search for a shift

/// A face between bone and no label.
struct Face {
    std::array<int, 3> voxel;
    std::array<int, 3> outwards;
};

std::vector<Face> faces_of(const BoneMask& mask) {
    std::vector<Face> faces;
    for_each_voxel(mask.image, [&](int i, int j, int k, std::size_t at) {
        if (mask.is_bone[at] == 0) return;
        for (const auto& step : face_neighbours) {
            const int x = i + step[0], y = j + step[1], z = k + step[2];
            if (!mask.image.has(x, y, z)) continue;
            const std::size_t next = mask.image.offset(x, y, z);
            if (mask.is_bone[next] == 0 && (mask.is_other.empty() || mask.is_other[next] == 0))
                faces.push_back({{i, j, k}, step});
        }
    });
    return faces;
}

/// Returns the mean of the values of `count` voxels from one voxel along a step. Ends at the image.
std::optional<double> mean_along(const VoxelImage& image, std::array<int, 3> voxel, std::array<int, 3> step,
                                 int count) {
    double sum = 0.0;
    int found = 0;
    for (; found < count && image.has(voxel[0], voxel[1], voxel[2]); ++found) {
        sum += static_cast<double>(image.at(voxel[0], voxel[1], voxel[2]));
        for (std::size_t axis = 0; axis < 3; ++axis) voxel[axis] += step[axis];
    }
    return found > 0 ? std::optional(sum / found) : std::nullopt;
}

/// Compares every `stride`-th face. Faces that leave the image are not compared.
LabelFit fit_of(const VoxelImage& image, const std::vector<Face>& faces, int reach, std::array<int, 3> shift,
                std::size_t stride = 1) {
    std::size_t compared = 0, brighter = 0;
    for (std::size_t n = 0; n < faces.size(); n += stride) {
        const auto& [voxel, outwards] = faces[n];
        std::array<int, 3> inner{}, outer{}, inwards{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            inner[axis] = voxel[axis] + shift[axis];
            outer[axis] = inner[axis] + outwards[axis];
            inwards[axis] = -outwards[axis];
        }
        const auto in = mean_along(image, inner, inwards, reach), out = mean_along(image, outer, outwards, reach);
        if (!in || !out) continue;
        ++compared;
        brighter += *in > *out ? 1 : 0;
    }
    return {compared, compared > 0 ? static_cast<double>(brighter) / static_cast<double>(compared) : 0.0};
}

/// Returns the fraction of the bone that is as dark as air. A value that is no HU has no air.
double air_fraction(const BoneMask& mask, const documents::CtSource& ct) {
    if (ct.intensity != documents::CtSource::Intensity::hounsfield) return 0.0;
    std::size_t dark = 0;
    for (std::size_t at = 0; at < mask.is_bone.size(); ++at)
        dark += mask.is_bone[at] != 0 && mask.image.values[at] < air ? 1 : 0;
    return static_cast<double>(dark) / static_cast<double>(std::max<std::size_t>(1, mask.count()));
}

/// Returns the area [m²] of the bone's border that lies on the end of the label map while the scan continues as bright.
double cut_area(const VoxelImage& scan, const std::vector<Face>& faces, const VoxelGrid& labels, double threshold,
                int reach) {
    double area = 0.0;
    for (const auto& [voxel, outwards] : faces) {
        std::array<int, 3> outer{};
        Vec3 index{};
        for (std::size_t axis = 0; axis < 3; ++axis) outer[axis] = voxel[axis] + outwards[axis];
        index = labels.index(
            scan.lps({static_cast<double>(outer[0]), static_cast<double>(outer[1]), static_cast<double>(outer[2])}));
        if (labels.has(static_cast<int>(std::lround(index.x)), static_cast<int>(std::lround(index.y)),
                       static_cast<int>(std::lround(index.z))))
            continue;
        const auto beyond = mean_along(scan, outer, outwards, reach);
        if (!beyond || *beyond < threshold) continue;
        double volume = scan.spacing(0) * scan.spacing(1) * scan.spacing(2);
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (outwards[axis] != 0) volume /= scan.spacing(axis);
        area += volume;
    }
    return area;
}

/// Labels that would fit better.
struct Alternative {
    std::string how;  ///< as in: "when …"
    double fit = 0.0;
};

std::string percent(double fraction) { return rounded(100.0 * fraction, 0) + " %"; }

std::string shift_text(const VoxelGrid& grid, const std::array<int, 3>& shift) {
    Vec3 sum{};
    for (std::size_t axis = 0; axis < 3; ++axis) sum = sum + static_cast<double>(shift[axis]) * grid.step(axis);
    const auto written = [](double metres) { return rounded(std::abs(metres) < 5e-6 ? 0.0 : metres * 1e3, 2); };
    return "moved by " + written(sum.x) + " " + written(sum.y) + " " + written(sum.z) + " mm";
}

/// Returns the best of the shifts by one or two voxels along one axis.
std::pair<std::array<int, 3>, double> best_nearby(const VoxelImage& image, const std::vector<Face>& faces, int reach) {
    const std::size_t stride = 1 + faces.size() / max_compared;
    std::pair<std::array<int, 3>, double> best{{}, 0.0};
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const int voxels : {-2, -1, 1, 2}) {
            std::array<int, 3> shift{};
            shift[axis] = voxels;
            if (const LabelFit fit = fit_of(image, faces, reach, shift, stride); fit.brighter_inside > best.second)
                best = {shift, fit.brighter_inside};
        }
    return best;
}

/// Returns the best shift, axis by axis.
Alternative best_shift(const VoxelImage& image, const std::vector<Face>& faces, int reach) {
    const std::size_t stride = 1 + faces.size() / max_compared;
    std::array<int, 3> best{};
    double fit = 0.0;
    for (int round = 0; round < 3; ++round)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const int farthest = static_cast<int>(farthest_shift / image.spacing(axis));
            std::array<int, 3> shift = best;
            for (shift[axis] = -farthest; shift[axis] <= farthest; ++shift[axis]) {
                const LabelFit here = fit_of(image, faces, reach, shift, stride);
                // A shift that leaves the region with half of the border is no explanation.
                if (2 * here.faces * stride < faces.size() || here.brighter_inside <= fit) continue;
                fit = here.brighter_inside;
                best = shift;
            }
        }
    return {shift_text(image, best), fit};
}

/// Returns the labels as they are with another grid; nothing if they do not cover the scan.
std::optional<double> fit_on_grid(const VoxelImage& scan, const documents::CtSource& ct, const LabelMap& labels,
                                  const VoxelGrid& grid, int reach) {
    const LabelMap moved{grid, labels.segments, [&](const VoxelRange& range, int layer) {
                             std::optional<VoxelImage> image = labels.read(range, layer);
                             if (image) static_cast<VoxelGrid&>(*image) = grid.part(range);
                             return image;
                         }};
    BoneMask mask(scan);
    try {
        if (!mark_labels(mask, ct, moved)) return std::nullopt;
    } catch (const ImportError&) {
        return std::nullopt;
    }
    const std::vector<Face> faces = faces_of(mask);
    if (faces.size() < min_faces) return std::nullopt;
    return fit_of(scan, faces, reach, {}).brighter_inside;
}

/// Returns the patient's direction that is nearest to an axis of a grid.
const char* direction_of(const VoxelGrid& grid, std::size_t axis) {
    const Vec3 step = grid.step(axis);
    const double x = std::abs(step.x), y = std::abs(step.y), z = std::abs(step.z);
    return x >= y && x >= z ? "left to right" : y >= z ? "front to back" : "head to feet";
}

std::vector<Alternative> mirror_images(const VoxelImage& scan, const documents::CtSource& ct, const LabelMap& labels,
                                       int reach) {
    std::vector<Alternative> found;
    const auto add = [&](const std::string& how, const VoxelGrid& grid) {
        if (const auto fit = fit_on_grid(scan, ct, labels, grid, reach)) found.push_back({how, *fit});
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
        VoxelGrid mirrored = labels.grid;
        std::array<Vec3, 3> steps{mirrored.step(0), mirrored.step(1), mirrored.step(2)};
        const Vec3 origin = mirrored.origin() + static_cast<double>(mirrored.size[axis] - 1) * steps[axis];
        steps[axis] = -1.0 * steps[axis];
        mirrored.place(steps[0], steps[1], steps[2], origin);
        add(std::string("mirrored ") + direction_of(labels.grid, axis), mirrored);
    }
    VoxelGrid turned = labels.grid;
    auto matrix = turned.lps_from_index;
    for (std::size_t n = 0; n < 8; ++n) matrix[n] = -matrix[n];
    turned.place(matrix);
    add("read as RAS", turned);
    return found;
}

}  // namespace

LabelFit label_fit(const BoneMask& mask, int reach, std::array<int, 3> shift) {
    return fit_of(mask.image, faces_of(mask), reach, shift);
}

void check_label_fit(const BoneMask& mask, const documents::Anatomy& anatomy, const LabelMap& labels,
                     std::vector<std::string>& notes, text::Diagnostics& diagnostics) {
    const VoxelImage& scan = mask.image;
    int reach = 2;  // [voxels] a coarser label map is known less well
    for (std::size_t axis = 0; axis < 3; ++axis)
        reach = std::max(reach, 1 + static_cast<int>(std::lround(labels.grid.spacing(axis) / scan.spacing(axis))));
    const std::vector<Face> faces = faces_of(mask);
    const LabelFit fit = fit_of(scan, faces, reach, {});
    if (fit.faces < min_faces) return;
    const std::string found =
        "the scan is brighter inside than outside at " + percent(fit.brighter_inside) + " of the labels' border";
    const auto warn = [&](const std::string& message) {
        diagnostics.push_back(
            text::warning_at(documents::in_anatomy(anatomy, {"ct", "labels", "file"}), "W0678", message));
    };
    notes.push_back("Labels: " + found + ".");
    if (const double cut = cut_area(scan, faces, labels.grid, anatomy.ct->threshold, reach); cut > max_cut)
        warn("the label map ends within the bone: at " + rounded(cut * 1e6, 0) +
             " mm2 of its end the scan is bone on the other side, and counts as air. Export the label map of the whole "
             "bone, or plan within it.");
    if (fit.brighter_inside >= bad_fit) {
        const auto& [shift, nearby] = best_nearby(scan, faces, reach);
        if (nearby > fit.brighter_inside + better_nearby)
            warn(found + ", and at " + percent(nearby) + " when they are " + shift_text(scan, shift) +
                 ". Check whether the label map was made on this scan.");
        return;
    }
    std::vector<Alternative> others = mirror_images(scan, *anatomy.ct, labels, reach);
    others.push_back(best_shift(scan, faces, reach));
    std::string better;
    for (const Alternative& other : others)
        if (other.fit >= good_fit && other.fit >= fit.brighter_inside + better_by)
            better += (better.empty() ? "; at " : ", at ") + percent(other.fit) + " when they are " + other.how;
    const double in_air = air_fraction(mask, *anatomy.ct);
    if (!better.empty() || in_air > max_air)
        throw ImportError{
            "E0630",
            {"ct", "labels", "file"},
            "the labels do not fit the scan: " + found + better +
                (in_air > max_air ? "; " + percent(in_air) + " of the kept voxels are as dark as air" : "") +
                ". Export the label map again from the scan that `ct.image` names."};
    std::string size;
    for (const bool is_grown : {false, true}) {
        BoneMask other = mask;
        spread(other, is_grown, 1.01 * std::max({scan.spacing(0), scan.spacing(1), scan.spacing(2)}));
        const LabelFit resized = fit_of(scan, faces_of(other), reach, {});
        if (resized.faces >= min_faces && resized.brighter_inside >= fit.brighter_inside + better_by)
            size = "; at " + percent(resized.brighter_inside) + " when they are " + (is_grown ? "grown" : "shrunk") +
                   " by one voxel";
    }
    warn("the labels hardly fit the scan: " + found + size +
         ". Labels of this scan reach 80 % and more, unrelated ones about 50 %. Check whether the label map belongs to "
         "this scan, and whether `keep` names the bone.");
}

}  // namespace kerf::bone
