// SPDX-License-Identifier: Apache-2.0
#include "app/import_source.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "app/progress.h"
#include "bone/image/scan.h"
#include "bone/image/write_nrrd.h"
#include "bone/import/mesh_body.h"
#include "bone/report/import_report.h"
#include "bone/surface/surface_mesh.h"
#include "bone/surface/write_stl.h"
#include "session/recorder.h"
#include "text/printable.h"
#include "text/write_file.h"

namespace kerf::app {
namespace {

constexpr int slab = 16;  // slices in memory at once
constexpr int min_bin = -2048, max_bin = 4096;

void add_line(std::string& text, const char* head, const std::string& line) {
    text += head;
    text.resize(text.size() + 8 - std::min<std::size_t>(8, std::string(head).size()), ' ');
    text += line + "\n";
}

bool ends_in(const std::string& name, const char* ending) {
    std::string lower = name;
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return lower.ends_with(ending);
}

// ---- scans ----------------------------------------------------------------------------------------------------------

/// A histogram of the voxels, and the range of their values.
struct Values {
    std::vector<std::size_t> counts = std::vector<std::size_t>(max_bin - min_bin + 1, 0);
    std::size_t all = 0;
    float smallest = HUGE_VALF, largest = -HUGE_VALF;
    bool fits_short = true;

    void add(const std::vector<float>& values) {
        for (const float v : values) {
            smallest = std::min(smallest, v);
            largest = std::max(largest, v);
            fits_short = fits_short && v == std::round(v) && v >= -32768.0f && v <= 32767.0f;
            ++counts[static_cast<std::size_t>(
                std::clamp(static_cast<int>(std::lround(std::clamp(v, -1e6f, 1e6f))), min_bin, max_bin) - min_bin)];
        }
        all += values.size();
    }
    [[nodiscard]] int quantile(double fraction) const {
        std::size_t seen = 0;
        for (std::size_t bin = 0; bin < counts.size(); ++bin)
            if ((seen += counts[bin]) >= static_cast<std::size_t>(fraction * static_cast<double>(all)))
                return static_cast<int>(bin) + min_bin;
        return max_bin;
    }
};

/// Passes all voxels to `take`, some slices at a time. Returns false if they cannot be read.
template <class Take>
bool for_each_slab(const bone::Scan& scan, text::Diagnostics& diagnostics, const bone::Progress& progress,
                   const Take& take) {
    const bone::VoxelGrid& grid = scan.grid();
    const int depth = scan.reads_by_slices() ? slab : grid.size[2];
    for (int k = 0; k < grid.size[2]; k += depth) {
        if (progress) progress(static_cast<double>(k) / grid.size[2], "reading voxels");
        const bone::VoxelRange range{{0, 0, k}, {grid.size[0], grid.size[1], std::min(depth, grid.size[2] - k)}};
        const auto image = scan.read(range, 0, {}).take(diagnostics);
        if (!image) return false;
        take(image->values);
    }
    return true;
}

std::string extent_text(const bone::VoxelGrid& grid) {
    const Box box = grid.box();
    const auto from_to = [](const char* axis, double low, double high) {
        return std::string(axis) + " " + bone::rounded(low * 1e3, 1) + " … " + bone::rounded(high * 1e3, 1);
    };
    return from_to("x", box.low.x, box.high.x) + ", " + from_to("y", box.low.y, box.high.y) + ", " +
           from_to("z", box.low.z, box.high.z) + " mm (LPS)";
}

/// Names the plane of the slices.
std::string direction_text(const bone::VoxelGrid& grid) {
    const Vec3 d = normalized(grid.step(2));
    const double x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
    const double largest = std::max({x, y, z});
    const std::string plane = largest == z ? "axial" : largest == y ? "coronal" : "sagittal";
    const double off = std::acos(std::min(1.0, largest)) * 180.0 / 3.14159265358979323846;
    return plane + (off > 0.5 ? ", turned by " + bone::rounded(off, 1) + " deg" : "");
}

void import_scan(const ImportRequest& request, ImportOutcome& outcome) {
    const bone::Progress progress = [](double fraction, const std::string& what) { show_progress(fraction, what); };
    const auto scan =
        bone::open_scan(request.source, {request.series, request.acquisition, request.may_resample}, progress)
            .take(outcome.diagnostics);
    if (!scan) return;
    for (const std::string& note : scan->notes()) add_line(outcome.text, "found", note);
    const bone::VoxelGrid& grid = scan->grid();
    add_line(outcome.text, "",
             std::to_string(grid.size[0]) + " × " + std::to_string(grid.size[1]) + " × " +
                 std::to_string(grid.size[2]) + " voxels at right angles, " + extent_text(grid) + ".");
    add_line(outcome.text, "", "Slices as they lie: " + direction_text(grid) + ".");
    for (const bone::Segment& segment : scan->segments())
        add_line(outcome.text, "",
                 "Structure `" + text::excerpt(segment.name) + "`: label " + std::to_string(segment.label) +
                     (segment.layer > 0 ? " in layer " + std::to_string(segment.layer) : "") + ".");
    Values values;
    const bool is_read =
        for_each_slab(*scan, outcome.diagnostics, progress, [&](const std::vector<float>& some) { values.add(some); });
    if (!is_read) return;
    if (scan->segments().empty())
        add_line(outcome.text, "",
                 "Values " + bone::rounded(values.smallest, 0) + " … " + bone::rounded(values.largest, 0) +
                     "; 1 % under " + std::to_string(values.quantile(0.01)) + ", half under " +
                     std::to_string(values.quantile(0.5)) + ", 1 % over " + std::to_string(values.quantile(0.99)) +
                     ".");
    if (request.out.empty()) return;
    bone::NrrdWriter writer(request.out, grid, session::notice_line, values.fits_short);
    if (!for_each_slab(*scan, outcome.diagnostics, progress, [&](const std::vector<float>& some) { writer.add(some); }))
        return;
    outcome.error = writer.finish();
    if (!outcome.error.empty()) return;
    const std::vector<bone::Segment>& structures = scan->segments();
    add_line(outcome.text, "wrote",
             request.out + (structures.empty() ? ""
                                               : ", without the names of its " + std::to_string(structures.size()) +
                                                     (structures.size() == 1 ? " structure" : " structures")));
    const auto left_out = std::count_if(structures.begin(), structures.end(),
                                        [](const bone::Segment& structure) { return structure.layer > 0; });
    if (left_out > 0)
        outcome.diagnostics.push_back(text::warning_about(
            request.out, "W0686",
            "Only the first layer of voxels was written: " + std::to_string(left_out) + " of " +
                std::to_string(structures.size()) +
                " structures lie in others, because they overlap. Name the source itself under `ct.labels`."));
}

// ---- surfaces -------------------------------------------------------------------------------------------------------

/// Returns what an STL file lacks of its source, as in ", without normals (120), lines (3)"; empty if it lacks nothing.
std::string without_ignored(const std::map<std::string, std::size_t>& ignored) {
    std::string text;
    for (const auto& [what, count] : ignored)
        text += (text.empty() ? ", without " : ", ") + what + " (" + std::to_string(count) + ")";
    return text;
}

/// Returns a length [m] with two digits or more, rounded up.
std::string rounded_up(double length) {
    double unit = 1e-2;  // [mm]
    int digits = 2;
    for (; digits < 9 && 1e3 * length < 10.0 * unit; ++digits) unit *= 0.1;
    return bone::rounded(std::ceil(1e3 * length / unit) * unit, digits) + " mm";
}

std::string rounding_text(const bone::StlLoss& loss) {
    return loss.displacement > 0.0 ? ", rounded by at most " + rounded_up(loss.displacement) : "";
}

/// Warns where the written numbers are coarse. A loss below a hundredth of a millimetre needs no warning.
void warn_of_loss(const bone::StlLoss& loss, std::size_t faces, const ImportRequest& request, ImportOutcome& outcome) {
    constexpr double visible = 10e-6;  // [m] half of the step that W0657 warns of
    if (loss.displacement <= visible && loss.flattened == 0) return;
    outcome.diagnostics.push_back(text::warning_about(
        request.out, "W0686",
        "STL rounded the surface: vertices are off by up to " + rounded_up(loss.displacement) + ", and " +
            std::to_string(loss.flattened) + " of " + std::to_string(faces) +
            " faces have lost their area. Move the surface to the origin where it was made, or name " +
            text::excerpt(request.source) + " itself in the anatomy."));
}

constexpr double longest_person = 3.0;  // [m]

/// Returns the longest side of the box around a bone [m].
double length_of(const bone::MeshBone& bone) {
    const Box box = bone::bounds_of(bone.surface);
    const Vec3 extent = box.high - box.low;
    return std::max({extent.x, extent.y, extent.z});
}

void import_surface(const ImportRequest& request, ImportOutcome& outcome) {
    auto surface = bone::read_surface(request.source).take(outcome.diagnostics);
    if (!surface) return;
    documents::Anatomy anatomy;
    anatomy.file = request.source;
    documents::MeshSource& mesh = anatomy.mesh.emplace();
    mesh.unit = request.unit == "cm" ? 1e-2 : request.unit == "m" ? 1.0 : request.unit == "um" ? 1e-6 : 1e-3;
    mesh.is_ras = request.frame == "RAS";
    mesh.names_frame = !request.frame.empty();
    const StillWorking sign_of_life("checking the surface");
    const std::string lacking = without_ignored(surface->ignored);
    const auto bone = bone::make_mesh_bone(anatomy, std::move(*surface), nullptr).take(outcome.diagnostics);
    if (!bone) return;
    if (const double length = length_of(*bone); length > longest_person) {
        outcome.error = "the surface is " + bone::rounded(length, 1) + " m long in `--unit " + request.unit +
                        "`, longer than a person. Write `--unit mm`, or the unit of its numbers.";
        return;
    }
    bool is_first = true;
    for (const std::string& note : bone->report.notes) {
        add_line(outcome.text, is_first ? "found" : "", note);
        is_first = false;
    }
    if (request.out.empty()) return;
    Mesh written;
    bone::SurfaceMesh whole = bone::whole_surface_of(*bone);
    written.vertices = std::move(whole.vertices);
    written.triangles = std::move(whole.triangles);
    outcome.error = text::write_file(request.out, bone::stl_bytes(written));
    if (!outcome.error.empty()) return;
    const bone::StlLoss loss = bone::stl_loss(written);
    add_line(outcome.text, "wrote", request.out + ", millimetres, LPS" + lacking + rounding_text(loss));
    warn_of_loss(loss, written.triangles.size(), request, outcome);
}

}  // namespace

ImportOutcome import_source(const ImportRequest& request) {
    ImportOutcome outcome;
    const bool is_surface =
        ends_in(request.source, ".stl") || ends_in(request.source, ".obj") || ends_in(request.source, ".ply");
    const char* ending = is_surface ? ".stl" : ".nrrd";
    if (!request.out.empty() && !ends_in(request.out, ending)) {
        outcome.error = std::string("`--out` must end in `") + ending + "` here.";
        return outcome;
    }
    if (is_surface)
        import_surface(request, outcome);
    else
        import_scan(request, outcome);
    return outcome;
}

}  // namespace kerf::app
