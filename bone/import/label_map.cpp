// SPDX-License-Identifier: Apache-2.0
#include "bone/import/label_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <set>
#include <utility>

#include "bone/import/import_error.h"
#include "bone/report/import_report.h"
#include "documents/solids.h"

namespace kerf::bone {
namespace {

using header::list_of;
using header::name_to_write;

/// Describes the structures that the segmentation names.
std::string known_segments(const std::vector<Segment>& segments) {
    return segments.empty() ? "It names none: write the label's number." : "It has " + list_of(segments) + ".";
}

/// Returns the only structure that matches. Refuses none, several, and one with the voxels of another.
template <class IsMeant>
Segment only_segment(const std::vector<Segment>& segments, const std::string& description, const IsMeant& is_meant) {
    const auto refuse = [](const char* code, const std::string& message) {
        throw ImportError{code, {"ct", "labels", "keep"}, message};
    };
    std::vector<Segment> found, alike;
    std::copy_if(segments.begin(), segments.end(), std::back_inserter(found), is_meant);
    if (found.empty())
        refuse("E0635", "the segmentation has no structure " + description + ". " + known_segments(segments));
    if (found.size() > 1)
        refuse("E0636", "the segmentation has " + std::to_string(found.size()) + " structures " + description + ": " +
                            list_of(found) +
                            ". Keep one by its name or its number, whichever no other has, or rename them in 3D "
                            "Slicer.");
    std::copy_if(segments.begin(), segments.end(), std::back_inserter(alike),
                 [&](const Segment& s) { return s.layer == found[0].layer && s.label == found[0].label; });
    if (alike.size() > 1)
        refuse("E0636", "the voxels of " + description + " cannot be distinguished from those of others: " +
                            list_of(alike) + ". Export the segmentation from 3D Slicer again.");
    return found[0];
}

/// Returns the labels and layers that are the bone.
std::vector<Segment> kept_segments(const documents::CtSource& ct, const std::vector<Segment>& segments) {
    std::vector<Segment> kept;
    for (const int label : ct.keep) {
        const bool is_named =
            std::any_of(segments.begin(), segments.end(), [&](const Segment& s) { return s.label == label; });
        const bool has_layers =
            std::any_of(segments.begin(), segments.end(), [](const Segment& s) { return s.layer > 0; });
        if (is_named || has_layers)
            kept.push_back(only_segment(segments, "with the label " + std::to_string(label),
                                        [&](const Segment& s) { return s.label == label; }));
        else
            kept.push_back({"", label, 0});
    }
    for (const std::string& name : ct.keep_named)
        kept.push_back(
            only_segment(segments, "`" + name_to_write(name) + "`", [&](const Segment& s) { return s.name == name; }));
    return kept;
}

/// Lists labels, at most twelve.
std::string listed(const std::set<int>& labels) {
    constexpr std::size_t max_listed = 12;
    std::string text;
    std::size_t count = 0;
    for (const int label : labels) {
        if (++count > max_listed) return text + " and " + std::to_string(labels.size() - max_listed) + " more";
        text += (text.empty() ? "" : ", ") + std::to_string(label);
    }
    return text.empty() ? "none" : text;
}

// ---- values ---------------------------------------------------------------------------------------------------------

[[noreturn]] void refuse_values(const std::string& got, const std::string& cure) {
    throw ImportError{
        "E0637",
        {"ct", "labels", "file"},
        "the label map holds " + got + ", must hold whole numbers from 0, one for each structure. " + cure};
}

constexpr const char* export_again =
    "It was smoothed, or resampled between labels. Export the labels themselves, or resample them with the nearest "
    "neighbour.";

/// Refuses values that are no labels: fractions and negative numbers.
void refuse_fractions(const VoxelImage& labels) {
    constexpr float rounding = 1e-3f;      // of a scaled value
    constexpr float largest = 16777216.f;  // above it, float skips whole numbers
    for (const float value : labels.values) {
        if (value < -rounding)
            refuse_values(rounded(static_cast<double>(value), 0), "This is a scan. Name the label map made on it.");
        if (value > largest || std::abs(value - std::round(value)) > rounding)
            refuse_values(rounded(static_cast<double>(value), 3), export_again);
    }
}

/// Refuses a map that was smoothed and then rounded: around a kept label, the numbers fall voxel by voxel.
void refuse_ramp(const VoxelImage& labels, int kept) {
    constexpr std::size_t min_values = 3;  // a cortex around cancellous bone is one
    constexpr double min_fraction = 0.9;   // of the faces of the label
    constexpr std::size_t min_faces = 50;  // fewer are chance
    std::set<int> values;
    std::size_t faces = 0, falling = 0;
    for_each_voxel(labels, [&](int i, int j, int k, std::size_t at) {
        const auto label_at = [&](int steps, const std::array<int, 3>& step) {
            const int x = i + steps * step[0], y = j + steps * step[1], z = k + steps * step[2];
            return labels.has(x, y, z) ? static_cast<int>(std::lround(labels.at(x, y, z))) : -1;
        };
        if (static_cast<int>(std::lround(labels.values[at])) != kept) return;
        for (const auto& step : face_neighbours) {
            const int next = label_at(1, step), second = label_at(2, step);
            if (next == kept || second < 0) continue;
            ++faces;
            if (next <= 0 || next > kept || second >= next) continue;
            ++falling;
            values.insert(next);
        }
    });
    if (faces < min_faces || values.size() < min_values ||
        static_cast<double>(falling) < min_fraction * static_cast<double>(faces))
        return;
    refuse_values("numbers that fall from " + std::to_string(kept) + " to 0 voxel by voxel, as " +
                      std::to_string(*values.rbegin()) + " and " + std::to_string(*values.begin()),
                  export_again);
}

// ---- the map on the scan --------------------------------------------------------------------------------------------

/// The nearest voxel of an image on another grid; 0 outside.
class NearestLabel {
public:
    NearestLabel(const VoxelImage& labels, const VoxelGrid& description)
        : labels_(labels), is_same_(on_one_grid(labels, description)), grid_(description) {}

    [[nodiscard]] float at(int i, int j, int k, std::size_t offset) const {
        if (is_same_) return labels_.values[offset];
        const Vec3 index =
            labels_.index(grid_.lps({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)}));
        const int x = static_cast<int>(std::lround(index.x)), y = static_cast<int>(std::lround(index.y)),
                  z = static_cast<int>(std::lround(index.z));
        return labels_.has(x, y, z) ? labels_.at(x, y, z) : 0.0f;
    }

private:
    const VoxelImage& labels_;
    bool is_same_;
    const VoxelGrid& grid_;
};

}  // namespace

bool mark_labels(BoneMask& mask, const documents::CtSource& ct, const LabelMap& labels) {
    const double around = std::max({labels.grid.spacing(0), labels.grid.spacing(1), labels.grid.spacing(2)});
    const VoxelRange range = labels.grid.range(grown(mask.image.box(), around));
    if (range.voxels() == 0)
        throw ImportError{"E0630",
                          {"ct", "labels", "file"},
                          "the label map covers nothing of the region around the axes. "
                          "Check that it belongs to this image."};
    const std::vector<Segment> kept = kept_segments(ct, labels.segments);
    std::set<int> layers, present;
    for (const Segment& segment : kept) layers.insert(segment.layer);
    mask.is_other.assign(mask.is_bone.size(), 0);
    for (const int layer : layers) {
        const std::optional<VoxelImage> read = labels.read(range, layer);
        if (!read) return false;
        refuse_fractions(*read);
        for (const Segment& segment : kept)
            if (segment.layer == layer && labels.segments.empty()) refuse_ramp(*read, segment.label);
        const NearestLabel nearest(*read, mask.image);
        for_each_voxel(mask.image, [&](int i, int j, int k, std::size_t at) {
            const auto label = static_cast<int>(std::lround(nearest.at(i, j, k, at)));
            if (label == 0) return;
            present.insert(label);
            const bool is_kept = std::any_of(kept.begin(), kept.end(),
                                             [&](const Segment& s) { return s.layer == layer && s.label == label; });
            if (is_kept)
                mask.is_bone[at] = 1;
            else
                mask.is_other[at] = 1;
        });
    }
    if (mask.count() == 0)
        throw ImportError{"E0633",
                          {"ct", "labels", "keep"},
                          "no voxel around the axes has a kept label. The label map has " + listed(present) +
                              " there. Check `ct.labels.keep`."};
    for (std::size_t at = 0; at < mask.is_bone.size(); ++at)
        if (mask.is_bone[at] != 0) mask.is_other[at] = 0;
    return true;
}

}  // namespace kerf::bone
