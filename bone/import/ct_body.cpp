// SPDX-License-Identifier: Apache-2.0
#include "bone/import/ct_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <utility>

#include "bone/import/bone_mask.h"
#include "bone/import/data_file.h"
#include "bone/import/fields_memory.h"
#include "bone/import/fit_landmarks.h"
#include "bone/import/import_error.h"
#include "bone/import/label_fit.h"
#include "bone/import/label_map.h"
#include "bone/import/label_pieces.h"
#include "bone/import/planned_region.h"
#include "bone/import/voxel_density.h"
#include "bone/import/voxel_distance.h"
#include "documents/read_anatomy.h"
#include "documents/solids.h"
#include "text/distinguishing_digits.h"
#include "text/printable.h"

namespace kerf::bone {
namespace {

constexpr double hounsfield_step = 50.0;  // [HU] change of the threshold for the uncertainty of a border
constexpr double grey_step = 0.05;        // [–] the same for grey levels, as a fraction of the threshold
constexpr double around_border = 12e-3;   // [m] range of distances on both sides, beyond all shells
constexpr float metal = 2800.0f;          // [HU] above enamel and cortex
constexpr double min_metal = 5e-9;        // [m³] less is not reported

std::string millimetres(double metres) { return rounded(metres * 1e3, 2); }

/// A scan and its labels, opened but not read, from any source.
struct Sources {
    VoxelGrid scan;
    std::function<std::optional<VoxelImage>(const VoxelRange&)> read_scan;
    std::optional<LabelMap> labels;
};

// ---- the mask -------------------------------------------------------------------------------------------------------

/// Keeps the requested piece. Returns a note with the number of pieces, or the distance of the landmark.
std::string keep_piece(BoneMask& mask, const documents::Anatomy& anatomy, bool has_labels) {
    const documents::CtSource& ct = *anatomy.ct;
    if (ct.component_at.empty()) {
        if (!has_labels) {
            const int pieces = keep_largest(mask);
            return "; of " + std::to_string(pieces) + " pieces the largest is kept, " + std::to_string(mask.count()) +
                   " voxels";
        }
        return "";
    }
    const auto landmark = std::find_if(anatomy.points.begin(), anatomy.points.end(),
                                       [&](const documents::LandmarkPoint& p) { return p.id == ct.component_at; });
    if (landmark == anatomy.points.end())
        throw ImportError{"E0634",
                          {"ct", "keep", "component_at"},
                          "there is no landmark point `" + ct.component_at +
                              "`, which `ct.keep` names. "
                              "Add it under `landmarks.points`."};
    const VoxelImage& image = mask.image;
    const double near =
        std::max(landmark->tolerance, 2.0 * std::max({image.spacing(0), image.spacing(1), image.spacing(2)}));
    const std::optional<double> way = keep_nearest(mask, landmark->at);
    if (way && *way > near)
        throw ImportError{"E0634",
                          {"landmarks", "points", ct.component_at},
                          "the nearest bone lies " + millimetres(*way) + " mm from `" + ct.component_at +
                              "`, must be within " + millimetres(near) + " mm. Check the landmark, or `ct.threshold`."};
    return way ? "; the piece at " + ct.component_at + " is kept, " + std::to_string(mask.count()) + " voxels" : "";
}

/// Returns the bone voxels for a border at `threshold`, and adds notes.
BoneMask mask_at(double threshold, BoneMask mask, const documents::Anatomy& anatomy, std::vector<std::string>& notes) {
    const documents::CtSource& ct = *anatomy.ct;
    const bool has_labels = !mask.is_other.empty();
    if (!has_labels)
        for (std::size_t at = 0; at < mask.is_bone.size(); ++at)
            mask.is_bone[at] = static_cast<double>(mask.image.values[at]) >= threshold;
    std::string note = "Mask: " + std::to_string(mask.count()) + " voxels " +
                       (has_labels ? std::string("by label") : "of " + rounded(threshold, 0) + " and more");
    if (has_labels) {
        for (const int one : ct.keep) note += " " + std::to_string(one);
        for (const std::string& one : ct.keep_named) note += " " + text::excerpt(one);
    }
    note += keep_piece(mask, anatomy, has_labels);

    const auto added_by = [&](const auto& change) {
        const std::size_t before = mask.count();
        change();
        const std::size_t after = mask.count();
        return (after < before ? "took " : "added ") + std::to_string(after < before ? before - after : after - before);
    };
    if (ct.closing > 0.0)
        note += "; closing by " + millimetres(ct.closing) + " mm " + added_by([&] {
                    spread(mask, true, ct.closing);
                    spread(mask, false, ct.closing);
                });
    if (ct.fill) note += "; filling cavities " + added_by([&] { fill_cavities(mask); });
    if (mask.count() > 0) {
        const std::vector<std::uint8_t> before = mask.is_bone;
        follow_grey(mask, threshold);
        std::size_t moved = 0;
        for (std::size_t at = 0; at < before.size(); ++at) moved += before[at] != mask.is_bone[at];
        note += "; the grey values moved " + std::to_string(moved) + " over the border";
    }
    if (mask.count() == 0)
        throw ImportError{
            "E0633",
            has_labels ? std::vector<std::string>{"ct", "labels", "keep"} : std::vector<std::string>{"ct", "threshold"},
            std::string("no voxel around the axes is bone. ") +
                (has_labels ? "Check `ct.labels.keep`." : "Lower `ct.threshold`.")};
    notes.push_back(note + ". In the end " + std::to_string(mask.count()) + " are bone.");
    return mask;
}

// ---- uncertainty ----------------------------------------------------------------------------------------------------

/// Returns where an axis enters bone [m from its beginning].
std::optional<double> entry_of(const documents::LandmarkAxis& axis, const VoxelImage& distance) {
    constexpr double step = 0.1e-3;  // [m]
    const Vec3 along = normalized(axis.to - axis.from);
    double before = 1.0;
    for (double way = 0.0; way <= length(axis.to - axis.from); way += step) {
        const double here = distance.sample_trilinear(axis.from + way * along, 1.0);
        if (here < 0.0) return way - step * (before < 1.0 ? here / (here - before) : 0.0);
        before = here;
    }
    return std::nullopt;
}

std::vector<BorderShift> border_shifts(const documents::Anatomy& anatomy, const BoneMask& blank,
                                       const VoxelImage& distance) {
    const documents::CtSource& ct = *anatomy.ct;
    const double step = ct.intensity == documents::CtSource::Intensity::hounsfield ? hounsfield_step
                                                                                   : grey_step * std::abs(ct.threshold);
    std::vector<std::string> ignored;
    const auto with = [&](double threshold) -> std::optional<VoxelImage> {
        try {
            return distance_in_voxels(mask_at(threshold, blank, anatomy, ignored), threshold, around_border).distance;
        } catch (const ImportError&) {
            return std::nullopt;
        }
    };
    const auto lower = with(ct.threshold - step), upper = with(ct.threshold + step);
    std::vector<BorderShift> shifts;
    for (const documents::LandmarkAxis& axis : anatomy.axes) {
        BorderShift shift{
            axis.id, step, ct.intensity == documents::CtSource::Intensity::hounsfield ? "HU" : "grey levels", {}, {}};
        const auto entry = entry_of(axis, distance);
        const auto moved = [&](const std::optional<VoxelImage>& other) -> std::optional<double> {
            const auto there = other ? entry_of(axis, *other) : std::nullopt;
            return entry && there ? std::optional(*there - *entry) : std::nullopt;
        };
        shift.lower = moved(lower);
        shift.upper = moved(upper);
        shifts.push_back(shift);
    }
    return shifts;
}

void doubt_values(const documents::Anatomy& anatomy, const VoxelImage& part, std::vector<std::string>& notes,
                  text::Diagnostics& diagnostics) {
    const documents::CtSource& ct = *anatomy.ct;
    if (ct.intensity != documents::CtSource::Intensity::hounsfield) {
        notes.push_back("The values are grey levels, not HU: the threshold holds for this scan alone.");
        return;
    }
    const auto warn = [&](const std::string& message) {
        diagnostics.push_back(text::warning_at(documents::in_anatomy(anatomy, {"ct", "image"}), "W0675", message));
        notes.push_back(message);
    };
    const float smallest = *std::min_element(part.values.begin(), part.values.end());
    if (smallest >= 0.0f)
        warn("No value around the axes is below 0 (the smallest is " + rounded(static_cast<double>(smallest), 0) +
             "), so these are hardly HU. If they are grey levels, as of a cone-beam CT, write `ct.intensity: grey`.");
    const auto bright = std::count_if(part.values.begin(), part.values.end(), [](float v) { return v >= metal; });
    const double volume = static_cast<double>(bright) * part.spacing(0) * part.spacing(1) * part.spacing(2);
    if (volume > min_metal)
        warn(rounded(volume * 1e9, 0) + " mm3 around the axes are brighter than " +
             rounded(static_cast<double>(metal), 0) +
             " HU, as metal and its streaks are: bone near them may be too thick or missing.");
}

// ---- the whole import -----------------------------------------------------------------------------------------------

/// Returns the region to read: the planned axes, and the search regions of fits.
Box region_to_read(const documents::Anatomy& anatomy, const Box& available) {
    const Box planned = planned_region(anatomy.axes, available);
    if (is_empty(planned) || !has_fits(anatomy)) return planned;
    const Box fits = region_of_fits(anatomy);
    const auto joined = [](Vec3 a, Vec3 b, const auto& which) {
        return Vec3{which(a.x, b.x), which(a.y, b.y), which(a.z, b.z)};
    };
    const auto smaller = [](double a, double b) { return std::min(a, b); };
    const auto larger = [](double a, double b) { return std::max(a, b); };
    return {joined(available.low, joined(planned.low, fits.low, smaller), larger),
            joined(available.high, joined(planned.high, fits.high, larger), smaller)};
}

/// Marks the kept labels, and compares them with the scan. Returns false if a layer cannot be read.
bool select_labels(BoneMask& mask, const documents::Anatomy& anatomy, const Sources& sources,
                   std::vector<std::string>& notes, text::Diagnostics& diagnostics) {
    if (!mark_labels(mask, *anatomy.ct, *sources.labels)) return false;
    if (const VoxelGrid& labels = sources.labels->grid; !on_one_grid(labels, sources.scan))
        notes.push_back("The labels lie on another grid than the image (voxels of " + millimetres(labels.spacing(0)) +
                        " × " + millimetres(labels.spacing(1)) + " × " + millimetres(labels.spacing(2)) +
                        " mm): each voxel got the nearest one.");
    check_label_fit(mask, anatomy, *sources.labels, notes, diagnostics);
    return true;
}

std::optional<CtBone> made(const documents::Anatomy& written, const Sources& sources, text::Diagnostics& diagnostics,
                           const ImportOptions& options) {
    documents::Anatomy anatomy = written;
    const documents::CtSource& ct = *anatomy.ct;
    if (sources.scan.is_sheared())
        throw ImportError{"E0632",
                          {"ct", "image"},
                          "the image's axes are not at right angles, as after a tilted gantry. "
                          "Resample the image onto a straight grid."};
    CtBone bone;
    bone.region = region_to_read(anatomy, sources.scan.box());
    const VoxelGrid& scan = sources.scan;
    // The margin lets closing and distance see both sides of the region's faces.
    const double margin = ct.closing + 3.0 * std::max({scan.spacing(0), scan.spacing(1), scan.spacing(2)});
    const VoxelRange range = is_empty(bone.region) ? VoxelRange{} : scan.range(grown(bone.region, margin));
    if (range.voxels() == 0)
        throw ImportError{"E0631",
                          {"landmarks", "axes"},
                          "the landmarks' axes lie outside the image. "
                          "Check that the axes are LPS, and the image is theirs."};
    // Values, mask, distance and densities, with temporary data
    constexpr double bytes_per_voxel = 25.0;
    if (const double bytes = bytes_per_voxel * static_cast<double>(range.voxels()); bytes > max_bone_memory) {
        const text::ComparedTexts memory = text::compared(bytes / max_bone_memory * 4.0, 4.0, 0, 6, &rounded);
        throw ImportError{"E0602",
                          {"landmarks", "axes"},
                          "around the planned axes lie " + rounded(static_cast<double>(range.voxels()) * 1e-6, 0) +
                              " million voxels, which take about " + memory.value + " GB of memory, must be at most " +
                              memory.bound +
                              " GB. Give axes that go no farther than what is planned, or "
                              "resample the image onto voxels " +
                              rounded(std::cbrt(bytes / max_bone_memory) + 0.05, 1) + " times as long."};
    }
    const std::optional<VoxelImage> part = sources.read_scan(range);
    if (!part) return std::nullopt;

    std::vector<std::string>& notes = bone.report.notes;
    const Vec3 extent = bone.region.high - bone.region.low;
    notes.push_back("CT: voxels of " + millimetres(scan.spacing(0)) + " × " + millimetres(scan.spacing(1)) + " × " +
                    millimetres(scan.spacing(2)) + " mm; of it " + rounded(extent.x * 1e3, 0) + " × " +
                    rounded(extent.y * 1e3, 0) + " × " + rounded(extent.z * 1e3, 0) +
                    " mm around the planned axes. Beyond, bone goes on and cannot be cut.");
    doubt_values(anatomy, *part, notes, diagnostics);

    BoneMask blank(*part);
    if (sources.labels && !select_labels(blank, anatomy, sources, notes, diagnostics)) return std::nullopt;
    const BoneMask mask = mask_at(ct.threshold, blank, anatomy, notes);
    if (sources.labels) check_label_pieces(mask, anatomy, diagnostics);
    bone.voxels = mask.count();
    double cortex = 0.0;
    for (const auto& tissue : anatomy.tissues) cortex += documents::thickest(tissue);
    VoxelDistance found = distance_in_voxels(mask, ct.threshold, cortex + around_border);
    bone.distance = std::move(found.distance);
    notes.push_back("Border: between the voxels where the values cross " + rounded(ct.threshold, 0) + ", at " +
                    rounded(100.0 * found.crossing_fraction, 0) + " % of it; half way between them at the rest.");

    if (has_fits(anatomy)) {
        const BoneShape shape{[&](Vec3 p) { return bone.distance.sample_trilinear(p, around_border); }, bone.region};
        if (!fit_landmarks(anatomy, shape, bone.report, diagnostics)) return std::nullopt;
        bone.region = planned_region(anatomy.axes, bone.region);
        if (is_empty(bone.region))
            throw ImportError{
                "E0631", {"landmarks", "axes"}, "the landmarks' axes lie outside the image. Check the fits."};
    }
    double sum = 0.0;
    std::size_t deep = 0;
    for (std::size_t at = 0; at < part->values.size(); ++at)
        if (static_cast<double>(bone.distance.values[at]) < -cortex) {
            sum += static_cast<double>(part->values[at]);
            ++deep;
        }
    bone.mean_value = deep > 0 ? sum / static_cast<double>(deep) : ct.threshold;
    if (ct.density) bone.density = densities_in_voxels(*part, bone.distance, cortex, anatomy, notes, diagnostics);
    if (options.with_scan)
        bone.report.scan_value = [kept = std::make_shared<const VoxelImage>(*part)](Vec3 lps) {
            return kept->sample_trilinear(lps, std::numeric_limits<double>::quiet_NaN());
        };
    if (options.with_shifts) bone.report.shifts = border_shifts(anatomy, blank, bone.distance);
    return bone;
}

std::optional<CtBone> make_or_report(const documents::Anatomy& anatomy, const Sources& sources,
                                     text::Diagnostics& diagnostics, const ImportOptions& options) {
    try {
        return made(anatomy, sources, diagnostics, options);
    } catch (const ImportError& refusal) {
        diagnostics.push_back(
            text::error_at(documents::in_anatomy(anatomy, refusal.keys), refusal.code, refusal.message));
    }
    return std::nullopt;
}

}  // namespace

text::Result<CtBone> make_ct_bone(const documents::Anatomy& anatomy, const VoxelImage& image, const VoxelImage* labels,
                                  const ImportOptions& options) {
    Sources sources;
    sources.scan = image;
    sources.read_scan = [&](const VoxelRange& range) { return image.cropped(range); };
    if (labels) {
        sources.labels = {*labels, {}, [labels](const VoxelRange& range, int) { return labels->cropped(range); }};
    }
    text::Diagnostics diagnostics;
    auto bone = make_or_report(anatomy, sources, diagnostics, options);
    if (!bone) return diagnostics;
    return {std::move(*bone), std::move(diagnostics)};
}

text::Result<CtBone> make_ct_bone(const documents::Anatomy& anatomy, const ImportOptions& options) {
    text::Diagnostics diagnostics;
    const documents::CtSource& ct = *anatomy.ct;
    const auto opened = [&](const std::string& written, const SeriesChoice& choice,
                            const std::vector<std::string>& keys) {
        const std::size_t first = diagnostics.size();
        const std::string file = found_data_file(written, anatomy.file);
        std::optional<Scan> scan;
        if (is_data_file_inside(file, anatomy.file, diagnostics))
            scan = open_scan(file, choice, options.progress).take(diagnostics);
        if (diagnostics.size() > first)
            text::because_of(documents::in_anatomy(anatomy, keys, "the scan is named here."), diagnostics, first);
        return scan;
    };
    const auto scan = opened(ct.image, {ct.series, ct.acquisition, ct.may_resample}, {"ct", "image"});
    if (!scan) return diagnostics;
    if (!scan->segments().empty()) {
        diagnostics.push_back(
            text::error_at(documents::in_anatomy(anatomy, {"ct", "image"}), "E0623",
                           "the image is a segmentation: it holds labels, no values. Name the scan that "
                           "it was made on, and the segmentation under `ct.labels`."));
        return diagnostics;
    }
    std::optional<Scan> labels;
    if (!ct.labels.empty() && !(labels = opened(ct.labels, {}, {"ct", "labels", "file"}))) return diagnostics;
    if (labels && labels->is_resampled()) {
        diagnostics.push_back(text::error_at(documents::in_anatomy(anatomy, {"ct", "labels", "file"}), "E0630",
                                             "the label map is sheared, and labels cannot be mixed. Make the labels on "
                                             "the image that `kerf import IMAGE -o straight.nrrd` writes."));
        return diagnostics;
    }

    Sources sources;
    sources.scan = scan->grid();
    const auto read = [&](const Scan& from, const VoxelRange& range, int layer, const std::vector<std::string>& keys) {
        const std::size_t first = diagnostics.size();
        auto image = from.read(range, layer, options.progress).take(diagnostics);
        if (diagnostics.size() > first)
            text::because_of(documents::in_anatomy(anatomy, keys, "the scan is named here."), diagnostics, first);
        return image;
    };
    sources.read_scan = [&](const VoxelRange& range) { return read(*scan, range, 0, {"ct", "image"}); };
    if (labels) {
        sources.labels = {labels->grid(), labels->segments(), [&](const VoxelRange& range, int layer) {
                              return read(*labels, range, layer, {"ct", "labels", "file"});
                          }};
    }
    auto bone = make_or_report(anatomy, sources, diagnostics, options);
    if (!bone) return diagnostics;
    bone->report.notes.insert(bone->report.notes.begin(), scan->notes().begin(), scan->notes().end());
    for (const Scan* one : std::array<const Scan*, 2>{&*scan, labels ? &*labels : nullptr}) {
        if (one == nullptr) continue;
        const auto hash = one->hash();
        if (!hash) {
            diagnostics.push_back(text::error_at(documents::in_anatomy(anatomy, {"ct", "image"}), "E0620",
                                                 "a file of the scan could be read once, but not again. Try again."));
            return diagnostics;
        }
        bone->report.file_hashes.push_back(*hash);
    }
    return {std::move(*bone), std::move(diagnostics)};
}

}  // namespace kerf::bone
