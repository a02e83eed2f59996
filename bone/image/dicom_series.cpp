// SPDX-License-Identifier: Apache-2.0
#include "bone/image/dicom_series.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "bone/image/acquisitions.h"
#include "bone/report/import_report.h"
#include "text/distinguishing_digits.h"
#include "text/printable.h"

namespace kerf::bone {
namespace {

constexpr double same_direction = 1e-3;  // [–] between unit vectors
constexpr double same_spacing = 1e-6;    // [m]
constexpr double degree = 3.14159265358979323846 / 180.0;

/// An error. `series_of()` turns it into a Diagnostic.
struct ReadError {
    const char* code;
    std::string message;
};

std::string millimetres(double metres) { return rounded(metres * 1e3, 2); }

/// Returns a spacing [mm] as the written volume has it: to 0.1 um, at least two decimals.
std::string spacing_text(double metres) {
    std::string text = rounded(metres * 1e3, 4);
    while (text.ends_with('0') && text.size() > text.find('.') + 3) text.pop_back();
    return text;
}
std::string counted(std::size_t n, const char* one, const char* many) {
    return std::to_string(n) + " " + (n == 1 ? one : many);
}

struct Group {
    std::string name;  ///< for people
    std::vector<const DicomHeader*> headers;
};

/// Groups slices by series UID. The name is the smallest series number. Series with the same number also get a letter.
std::vector<Group> groups_of(const std::vector<const DicomHeader*>& slices) {
    std::map<std::string, std::vector<const DicomHeader*>> by_series;
    for (const DicomHeader* header : slices) by_series[header->slice.series].push_back(header);
    std::map<int, std::vector<Group>> by_number;
    for (auto& [uid, headers] : by_series) {
        const auto least = std::min_element(headers.begin(), headers.end(), [](const auto* a, const auto* b) {
            return a->slice.series_number < b->slice.series_number;
        });
        by_number[(*least)->slice.series_number].push_back({"", headers});
    }
    std::vector<Group> groups;
    for (auto& [number, same_number] : by_number)
        for (std::size_t n = 0; n < same_number.size(); ++n) {
            same_number[n].name = std::to_string(number);
            if (same_number.size() > 1)
                same_number[n].name +=
                    n < 26 ? std::string(1, static_cast<char>('a' + n)) : "-" + std::to_string(n + 1);
            groups.push_back(same_number[n]);
        }
    return groups;
}

std::string offer_of(const Group& group) {
    const DicomSlice& first = group.headers.front()->slice;
    std::string text = "`" + group.name + "`: " + counted(group.headers.size(), "slice", "slices");
    if (first.columns > 0)
        text += " of " + std::to_string(first.columns) + " × " + std::to_string(first.rows) + " pixels";
    if (first.between_columns > 0.0) text += ", " + millimetres(first.between_columns) + " mm each";
    if (!first.modality.empty()) text += ", " + first.modality;
    if (first.is_localizer) text += ", an overview";
    return text;
}

/// Returns the first entries of a list, and the number of the others.
std::string listed(const std::vector<std::string>& all, const char* others) {
    constexpr std::size_t most = 6;
    std::string text;
    for (std::size_t n = 0; n < std::min(most, all.size()); ++n) text += (n > 0 ? "; " : "") + all[n];
    if (all.size() > most) text += "; and " + std::to_string(all.size() - most) + " more " + others;
    return text;
}

/// Returns the chosen series. Messages list the largest series first. Without a volume in any series no choice helps.
const Group& chosen(const std::vector<Group>& groups, const std::string& name) {
    if (name.empty() && groups.size() == 1) return groups.front();
    std::vector<const Group*> sorted;
    for (const Group& group : groups) sorted.push_back(&group);
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const Group* a, const Group* b) { return a->headers.size() > b->headers.size(); });
    std::vector<std::string> offers;
    for (const Group* group : sorted) offers.push_back(offer_of(*group));
    const std::string series = counted(groups.size(), "series", "series");
    if (name.empty() && sorted.front()->headers.size() < 2)
        throw ReadError{"E0661",
                        "the folder has " + series + " of one slice each: got " + listed(offers, "series") +
                            ", expected one series of at least 2. Export the slices of a volume as one series. "
                            "Some anonymisers write another series UID (0020,000e) into each file."};
    if (name.empty())
        throw ReadError{"E0661", "the folder has " + series + ": got " + listed(offers, "series") +
                                     ", expected one. Choose one: write `ct.series: " + sorted.front()->name +
                                     "`, or `--series " + sorted.front()->name + "`."};
    for (const Group& group : groups)
        if (group.name == name) return group;
    throw ReadError{"E0662", "the folder has no series `" + text::excerpt(name) + "`: expected one of " +
                                 listed(offers, "series") + ". Choose one of these."};
}

/// Some anonymisers give every slice its own frame of reference. Then the frame contains no information.
bool has_frame_each(const std::vector<DicomSlice>& slices) {
    std::set<std::string> frames;
    for (const DicomSlice& slice : slices) frames.insert(slice.frame_of_reference);
    return slices.size() > 2 && frames.size() == slices.size();
}

void check_alike(const std::vector<DicomSlice>& slices) {
    const DicomSlice& first = slices.front();
    const auto differing = [&](const auto& differs) {
        return static_cast<std::size_t>(std::count_if(slices.begin(), slices.end(), differs));
    };
    const auto refuse = [&](std::size_t count, const std::string& what) {
        if (count > 0)
            throw ReadError{"E0663", counted(count, "slice differs", "slices differ") + " from the first one in " +
                                         what + ", expected the same. Export one volume at a time."};
    };
    refuse(differing([&](const DicomSlice& s) { return s.columns != first.columns || s.rows != first.rows; }),
           "number of pixels");
    refuse(differing([&](const DicomSlice& s) {
               return length(s.along_row - first.along_row) > same_direction ||
                      length(s.down_column - first.down_column) > same_direction;
           }),
           "orientation");
    refuse(differing([&](const DicomSlice& s) {
               return std::abs(s.between_columns - first.between_columns) > same_spacing ||
                      std::abs(s.between_rows - first.between_rows) > same_spacing;
           }),
           "pixel spacing");
    if (!has_frame_each(slices))
        refuse(differing([&](const DicomSlice& s) { return s.frame_of_reference != first.frame_of_reference; }),
               "frame of reference");
    refuse(differing([&](const DicomSlice& s) { return s.modality != first.modality; }), "modality");
}

SliceStack stack_of(std::vector<DicomSlice>& slices) {
    const DicomSlice& first = slices.front();
    SliceStack stack{
        first.columns, first.rows, first.between_columns * first.along_row, first.between_rows * first.down_column, {}};
    const Vec3 normal = stack.normal();
    std::stable_sort(slices.begin(), slices.end(), [&](const DicomSlice& a, const DicomSlice& b) {
        const double along_a = dot(a.origin, normal), along_b = dot(b.origin, normal);
        return along_a != along_b ? along_a < along_b : a.instance < b.instance;
    });
    for (const DicomSlice& slice : slices) stack.origins.push_back(slice.origin);
    return stack;
}

/// Returns the plane's position as a viewer shows it: along the axis closest to its normal.
std::string plane_text(const SliceStack& stack, std::size_t slice) {
    const Vec3 n = stack.normal(), at = stack.origins[slice];
    const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
    if (z >= x && z >= y) return "z " + millimetres(at.z) + " mm";
    return x >= y ? "x " + millimetres(at.x) + " mm" : "y " + millimetres(at.y) + " mm";
}

std::string offer_of(const Acquisition& one) {
    return "`" + one.name + "`: " + counted(one.slices.size(), "slice", "slices") + ", " + millimetres(one.low) +
           " … " + millimetres(one.high) + " mm along their normal";
}

/// Keeps the slices of one acquisition. Several acquisitions form one volume only if each covers another part of the
/// patient.
void choose_acquisition(DicomSeries& series, const std::string& name, const std::string& folder,
                        text::Diagnostics& diagnostics) {
    const std::vector<Acquisition> all = acquisitions_of(series.slices);
    std::vector<std::string> offers;
    for (const Acquisition& one : all) offers.push_back(offer_of(one));
    if (!name.empty()) {
        const auto found = std::find_if(all.begin(), all.end(), [&](const Acquisition& a) { return a.name == name; });
        if (found == all.end())
            throw ReadError{"E0677", "the series has no acquisition `" + text::excerpt(name) + "`: expected one of " +
                                         listed(offers, "acquisitions") + ". Choose one of these."};
        std::vector<DicomSlice> kept;
        for (const std::size_t n : found->slices) kept.push_back(series.slices[n]);
        series.slices = std::move(kept);
        series.notes.push_back("Of " + counted(all.size(), "acquisition", "acquisitions") + " in the series `" + name +
                               "` was taken.");
        return;
    }
    if (all.size() == 1) return;
    const Acquisition& largest = *std::max_element(
        all.begin(), all.end(), [](const auto& a, const auto& b) { return a.slices.size() < b.slices.size(); });
    if (do_overlap(all))
        throw ReadError{"E0676", "the series has " + std::to_string(all.size()) +
                                     " acquisitions of the same part of the patient: got " +
                                     listed(offers, "acquisitions") +
                                     ", expected one. Choose one: write `ct.acquisition: " + largest.name +
                                     "`, or `--acquisition " + largest.name + "`."};
    const std::string message = "The slices belong to " + std::to_string(all.size()) +
                                " acquisitions of different parts of the patient: " + listed(offers, "acquisitions") +
                                ". They were joined. The patient may have moved between them.";
    series.notes.push_back(message);
    // A scanner that stops after every slice, or every few slices, numbers each stop. That needs no warning.
    if (largest.slices.size() > 1) diagnostics.push_back(text::warning_about(folder, "W0673", message));
}

void check_positions(const DicomSeries& series, bool may_resample) {
    const StackShape& shape = series.shape;
    if (shape.repeated > 0) {
        std::size_t n = 1;
        while (n + 1 < series.slices.size() &&
               series.stack.height(n) - series.stack.height(n - 1) > std::max(1e-6, 1e-3 * shape.distance))
            ++n;
        throw ReadError{"E0664", counted(shape.repeated, "slice lies", "slices lie") +
                                     " in the plane of another one: the first at " + plane_text(series.stack, n) +
                                     " (instances " + std::to_string(series.slices[n - 1].instance) + " and " +
                                     std::to_string(series.slices[n].instance) +
                                     "), expected one slice for each plane. Remove the copies, or export one phase."};
    }
    if (!shape.gaps.empty() && !may_resample) {
        std::string where;
        for (std::size_t g = 0; g < std::min<std::size_t>(3, shape.gaps.size()); ++g)
            where += (g > 0 ? ", " : "") + millimetres(shape.gaps[g].width) + " mm behind " +
                     plane_text(series.stack, shape.gaps[g].behind);
        if (shape.gaps.size() > 3) where += " and " + std::to_string(shape.gaps.size() - 3) + " more";
        throw ReadError{"E0665", "slices are missing: got " + counted(shape.gaps.size(), "gap", "gaps") + ", " + where +
                                     ", expected slices " + millimetres(shape.distance) +
                                     " mm apart. Export all slices. To fill the gaps by interpolation, write "
                                     "`ct.resample: true` or `--allow-resample`."};
    }
    if (shape.is_crooked() && !may_resample) {
        const text::ComparedTexts shown = text::compared(shape.crookedness, 0.1, 1, 6, &rounded);
        throw ReadError{"E0666", "the slices are shifted sideways: got up to " + shown.value +
                                     " voxels from the line through all, expected at most " + shown.bound +
                                     ". Export one volume. If "
                                     "the positions are right, write "
                                     "`ct.resample: true` or `--allow-resample`."};
    }
}

void note_shape(DicomSeries& series, const std::string& folder, text::Diagnostics& diagnostics) {
    const StackShape& shape = series.shape;
    const DicomSlice& first = series.slices.front();
    const std::size_t count = series.slices.size();
    const double whole = series.stack.height(count - 1);
    const double apart = shape.is_even() ? whole / static_cast<double>(count - 1) : shape.distance;
    series.notes.push_back("DICOM series: " + counted(count, "slice", "slices") + " of " +
                           std::to_string(first.columns) + " × " + std::to_string(first.rows) + " pixels of " +
                           millimetres(first.between_columns) + " × " + millimetres(first.between_rows) + " mm, " +
                           spacing_text(apart) + " mm apart, sorted along their normal.");
    const auto warn = [&](const char* code, const std::string& message) {
        diagnostics.push_back(text::warning_about(folder, code, message));
        series.notes.push_back(message);
    };
    if (shape.is_tilted())
        warn("W0671", "The slices are shifted sideways by " + rounded(shape.shift, 1) + " voxels in total (" +
                          rounded(shape.tilt / degree, 1) +
                          " deg, as with a tilted gantry). Resampling straightened them.");
    if (!shape.is_even() || shape.is_crooked())
        warn("W0672", "The slices are not stacked evenly: got distances of " + millimetres(shape.min_distance) +
                          " to " + millimetres(shape.max_distance) + " mm" +
                          (shape.gaps.empty() ? "" : ", with " + counted(shape.gaps.size(), "gap", "gaps")) +
                          ". They were resampled every " + spacing_text(whole / straight_steps(series.stack, shape)) +
                          " mm, by linear interpolation.");
    const bool has_tilt = first.tilt && std::abs(*first.tilt) > 0.5 * degree;
    if (has_tilt && std::abs(std::abs(*first.tilt) - shape.tilt) > 0.5 * degree)
        warn("W0673", "The gantry tilt contradicts the slice positions: got " + rounded(*first.tilt / degree, 1) +
                          " deg in the header, " + rounded(shape.tilt / degree, 1) +
                          " deg by the positions. The positions were used.");
    if (first.between_slices && *first.between_slices > 0.0 &&
        std::abs(*first.between_slices - shape.distance) > 0.05 * shape.distance)
        warn("W0673", "The slice distance (0018,0088) contradicts the slice positions: got " +
                          millimetres(*first.between_slices) + " mm in the header, " + millimetres(shape.distance) +
                          " mm by the positions. The positions were used.");
    if (first.modality == "CT" && !first.values.empty() && first.values != "HU")
        warn("W0673", "The values are not HU: got `" + first.values +
                          "` (0028,1054), expected HU. Give a threshold in these values, and `ct.intensity: grey`.");
    if (first.modality != "CT")
        warn("W0673", "The series is not a CT: got " + (first.modality.empty() ? "no modality" : first.modality) +
                          ", expected CT. Its values are not HU. Give a threshold in its own values, and "
                          "`ct.intensity: grey`.");
    if (has_frame_each(series.slices))
        warn("W0673",
             "Each slice has its own frame of reference, as some anonymisers write it. The positions were used "
             "as if they were in one frame.");
    const auto lossy =
        std::count_if(series.slices.begin(), series.slices.end(), [](const DicomSlice& s) { return s.is_lossy; });
    if (lossy > 0)
        warn("W0673", counted(static_cast<std::size_t>(lossy), "slice was", "slices were") +
                          " compressed with loss. Borders may have moved.");
    std::set<std::pair<double, double>> scales;
    for (const DicomSlice& s : series.slices) scales.insert({s.slope, s.intercept});
    if (scales.size() > 1)
        series.notes.push_back("The slices have " + std::to_string(scales.size()) +
                               " different rescale slopes or intercepts. Each slice was scaled by its own.");
}

DicomSeries checked_series(const std::vector<DicomHeader>& headers, const SeriesChoice& choice,
                           const std::string& folder, text::Diagnostics& diagnostics) {
    std::vector<const DicomHeader*> slices;
    std::size_t damaged = 0, others = 0, no_dicom = 0;
    const DicomHeader* first_damaged = nullptr;
    for (const DicomHeader& header : headers) {
        if (header.kind == DicomHeader::Kind::slice) slices.push_back(&header);
        if (header.kind == DicomHeader::Kind::other || header.kind == DicomHeader::Kind::no_slice) ++others;
        if (header.kind == DicomHeader::Kind::other) ++no_dicom;
        if (header.kind == DicomHeader::Kind::damaged && ++damaged == 1) first_damaged = &header;
    }
    if (damaged > 0)
        throw ReadError{"E0668", counted(damaged, "file is", "files are") + " damaged, the first one because " +
                                     first_damaged->trouble + ". Copy the folder again."};
    if (slices.empty() && headers.empty())
        throw ReadError{"E0660", "the folder is empty. Name the folder with the DICOM files."};
    if (slices.empty())
        throw ReadError{"E0660", "none of the folder's " + counted(headers.size(), "file", "files") +
                                     " is a DICOM slice: " + counted(no_dicom, "is not DICOM", "are not DICOM") + ", " +
                                     counted(headers.size() - no_dicom, "has no image", "have no image") +
                                     ". Name the folder with the DICOM files."};
    const std::vector<Group> groups = groups_of(slices);
    const Group& group = chosen(groups, choice.name);

    DicomSeries series;
    std::size_t unusable = 0;
    const DicomHeader* first_unusable = nullptr;
    for (const DicomHeader* header : group.headers) {
        series.slices.push_back(header->slice);
        if (!header->trouble.empty() && ++unusable == 1) first_unusable = header;
    }
    if (unusable > 0)
        throw ReadError{"E0667", counted(unusable, "slice", "slices") + " of " + std::to_string(series.slices.size()) +
                                     " cannot be used, the first one because " + first_unusable->trouble +
                                     ". Export the series as single-frame CT slices."};
    if (series.slices.size() < 2)
        throw ReadError{"E0669",
                        "the series has too few slices: got 1, expected at least 2. Name the folder with all of them."};
    check_alike(series.slices);
    choose_acquisition(series, choice.acquisition, folder, diagnostics);
    if (series.slices.size() < 2)
        throw ReadError{"E0669", "the acquisition has too few slices: got 1, expected at least 2. Choose another one."};
    series.stack = stack_of(series.slices);
    series.shape = shape_of(series.stack);
    check_positions(series, choice.may_resample);
    if (straight_grid(series.stack, series.shape).size[0] == 0)
        throw ReadError{"E0669", "the volume has too many voxels: expected at most 512 million. Export a part of it."};
    note_shape(series, folder, diagnostics);
    if (others > 0)
        series.notes.push_back(counted(others, "other file", "other files") + " in the folder had no slice.");
    return series;
}

}  // namespace

text::Result<DicomSeries> series_of(const std::vector<DicomHeader>& headers, const SeriesChoice& choice,
                                    const std::string& folder) {
    text::Diagnostics diagnostics;
    try {
        DicomSeries series = checked_series(headers, choice, folder, diagnostics);
        return {std::move(series), std::move(diagnostics)};
    } catch (const ReadError& refusal) {
        diagnostics.push_back(text::error_about(folder, refusal.code, refusal.message));
    }
    return diagnostics;
}

}  // namespace kerf::bone
