// SPDX-License-Identifier: Apache-2.0
#include "bone/image/scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <system_error>

#include "bone/image/dicom_elements.h"
#include "bone/image/read_image.h"
#include "bone/report/import_report.h"

namespace kerf::bone {
namespace {

constexpr std::size_t max_files = 20'000;  // in a folder
constexpr double degree = 3.14159265358979323846 / 180.0;

/// Returns all files in a folder and its subfolders, sorted. Does not follow links; leaves out hidden files.
std::optional<std::vector<std::string>> files_in(const std::string& folder, text::Diagnostics& diagnostics) {
    namespace fs = std::filesystem;
    std::vector<std::string> files;
    std::error_code error;
    fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, error), end;
    for (; !error && at != end; at.increment(error)) {
        const std::string name = at->path().filename().string();
        std::error_code ignored;
        if (!name.empty() && name.front() == '.') {
            if (at->is_directory(ignored)) at.disable_recursion_pending();
            continue;
        }
        if (!at->is_symlink(ignored) && at->is_regular_file(ignored)) files.push_back(at->path().string());
        if (files.size() > max_files) {
            diagnostics.push_back(text::error_about(
                folder, "E0670", "the folder holds more than 20000 files. Name the folder of one series."));
            return std::nullopt;
        }
    }
    if (error) {
        diagnostics.push_back(text::error_about(folder, "E0670", "the folder cannot be read. Check its permissions."));
        return std::nullopt;
    }
    std::sort(files.begin(), files.end());
    return files;
}

// ---- a sheared file -------------------------------------------------------------------------------------------------

/// A permutation of a grid's axes to columns, rows and slices of a stack.
struct AxisOrder {
    std::array<std::size_t, 3> axis{0, 1, 2};  ///< columns, rows, slices
};

/// Returns the order in which two axes at right angles lie within the slices; nothing if these are sheared, too.
std::optional<AxisOrder> slices_of(const VoxelGrid& grid) {
    const auto lean = [&](std::size_t a, std::size_t b) {
        return std::abs(dot(grid.step(a), grid.step(b))) / (grid.spacing(a) * grid.spacing(b));
    };
    constexpr double straight = 1e-3;
    for (const AxisOrder order : {AxisOrder{{0, 1, 2}}, AxisOrder{{1, 2, 0}}, AxisOrder{{2, 0, 1}}})
        if (lean(order.axis[0], order.axis[1]) <= straight) return order;
    return std::nullopt;
}

struct StackOfImage {
    AxisOrder order;
    SliceStack stack;
    bool is_backwards = false;  ///< the last slice of the image is the first of the stack
};

StackOfImage stack_of(const VoxelGrid& grid, const AxisOrder& order) {
    StackOfImage result{order, {}, false};
    SliceStack& stack = result.stack;
    stack.columns = grid.size[order.axis[0]];
    stack.rows = grid.size[order.axis[1]];
    stack.along_row = grid.step(order.axis[0]);
    stack.down_column = grid.step(order.axis[1]);
    const Vec3 step = grid.step(order.axis[2]);
    const int count = grid.size[order.axis[2]];
    result.is_backwards = dot(step, stack.normal()) < 0.0;
    for (int n = 0; n < count; ++n)
        stack.origins.push_back(grid.origin() + static_cast<double>(result.is_backwards ? count - 1 - n : n) * step);
    return result;
}

std::vector<float> slice_of(const VoxelImage& image, const StackOfImage& of, std::size_t slice) {
    std::vector<float> values;
    values.reserve(static_cast<std::size_t>(of.stack.columns) * static_cast<std::size_t>(of.stack.rows));
    std::array<int, 3> at{};
    const int last = image.size[of.order.axis[2]] - 1;
    at[of.order.axis[2]] = of.is_backwards ? last - static_cast<int>(slice) : static_cast<int>(slice);
    for (int row = 0; row < of.stack.rows; ++row)
        for (int column = 0; column < of.stack.columns; ++column) {
            at[of.order.axis[0]] = column;
            at[of.order.axis[1]] = row;
            values.push_back(image.at(at[0], at[1], at[2]));
        }
    return values;
}

VoxelGrid placed(const ImageFile& file) {
    VoxelGrid grid;
    grid.size = file.size;
    grid.place(file.lps_from_index);
    return grid;
}

const char* name_of(ImageFile::Format format) {
    return format == ImageFile::Format::nifti ? "NIfTI" : format == ImageFile::Format::nrrd ? "NRRD" : "MetaImage";
}

std::string size_text(const VoxelGrid& grid) {
    const auto mm = [&](std::size_t axis) { return rounded(1e3 * grid.spacing(axis), 2); };
    return std::to_string(grid.size[0]) + " × " + std::to_string(grid.size[1]) + " × " + std::to_string(grid.size[2]) +
           " voxels of " + mm(0) + " × " + mm(1) + " × " + mm(2) + " mm";
}

text::Result<VoxelImage> read_slices(const DicomSeries& series, const VoxelGrid& grid, const VoxelRange& range,
                                     const std::string& source, const Progress& progress) {
    std::string trouble;
    const auto read = [&](std::size_t n) {
        if (progress) progress(static_cast<double>(n) / static_cast<double>(series.slices.size()), "reading slices");
        return read_dicom_voxels(series.slices[n], trouble);
    };
    VoxelImage image = straightened(series.stack, series.shape, grid, range, read);
    if (image.values.empty())
        return text::Diagnostics{text::error_about(
            source, "E0674", "a slice cannot be read: " + trouble + ". Export the series again, without compression.")};
    return image;
}

}  // namespace

text::Result<VoxelImage> Scan::read(const VoxelRange& range, int layer, const Progress& progress) const {
    if (series_) return read_slices(*series_, grid_, range, source_, progress);
    const VoxelGrid stored = placed(*file_);
    if (!stored.is_sheared()) return read_image(source_, *file_, range, layer);

    const text::Result<VoxelImage> image = read_image(source_, *file_, stored.all(), layer);
    if (!image) return image.diagnostics();
    const StackOfImage of = stack_of(stored, *slices_of(stored));
    return straightened(of.stack, shape_of(of.stack), grid_, range,
                        [&](std::size_t slice) { return slice_of(*image, of, slice); });
}

bool Scan::is_resampled() const noexcept {
    return series_ ? !series_->shape.is_straight() : placed(*file_).is_sheared();
}

std::optional<std::uint64_t> Scan::hash() const {
    std::vector<std::string> files;
    if (series_)
        for (const DicomSlice& slice : series_->slices) files.push_back(slice.file);
    else
        files.push_back(source_);
    if (file_ && file_->data_file != source_) files.push_back(file_->data_file);  // a header without voxels
    std::vector<std::uint64_t> hashes;
    for (const std::string& file : files)
        if (!hash_of_file(file, hashes.emplace_back())) return std::nullopt;
    return hashes.size() == 1 ? hashes.front() : hash_of_hashes(hashes);
}

text::Result<Scan> open_scan(const std::string& path, const SeriesChoice& choice, const Progress& progress) {
    text::Diagnostics diagnostics;
    Scan scan;
    scan.source_ = path;
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) {
        const auto files = files_in(path, diagnostics);
        if (!files) return diagnostics;
        std::vector<DicomHeader> headers;
        for (const std::string& file : *files) {
            if (progress && headers.size() % 16 == 0)
                progress(static_cast<double>(headers.size()) / static_cast<double>(files->size()), "reading headers");
            headers.push_back(read_dicom_header(file));
        }
        scan.series_ = series_of(headers, choice, path).take(diagnostics);
        if (!scan.series_) return diagnostics;
        scan.grid_ = straight_grid(scan.series_->stack, scan.series_->shape);
        scan.notes_ = scan.series_->notes;
        return {std::move(scan), std::move(diagnostics)};
    }
    if (read_dicom_elements(path).is_dicom) {
        diagnostics.push_back(text::error_about(
            path, "E0669",
            "this is one DICOM file; a volume needs all slices of its series. Name the folder that holds them."));
        return diagnostics;
    }
    scan.file_ = check_image_file(path).take(diagnostics);
    if (!scan.file_) return diagnostics;
    scan.segments_ = scan.file_->segments;
    scan.grid_ = placed(*scan.file_);
    const std::string sort = scan.segments_.empty() ? "" : ", a segmentation: labels, no values";
    scan.notes_.push_back(std::string(name_of(scan.file_->format)) + sort + ": " + size_text(scan.grid_) + ".");
    for (const std::string& doubt : scan.file_->doubts) {
        diagnostics.push_back(text::warning_about(path, "W0673", doubt));
        scan.notes_.push_back(doubt);
    }
    if (!scan.grid_.is_sheared()) return {std::move(scan), std::move(diagnostics)};

    const auto order = slices_of(scan.grid_);
    if (!order) {
        diagnostics.push_back(text::error_about(
            path, "E0632", "no two of the image's axes are at right angles. Resample the image onto a straight grid."));
        return diagnostics;
    }
    const StackOfImage of = stack_of(scan.grid_, *order);
    const StackShape shape = shape_of(of.stack);
    const std::string sheared = "The image is sheared by " + rounded(shape.tilt / degree, 1) +
                                " deg, as after a tilted gantry. It was put straight by resampling.";
    diagnostics.push_back(text::warning_about(path, "W0671", sheared));
    scan.notes_.push_back(sheared);
    scan.grid_ = straight_grid(of.stack, shape);
    if (scan.grid_.size[0] == 0) {
        diagnostics.push_back(text::error_about(
            path, "E0669", "put straight, the volume has more than 512 million voxels. Crop the image."));
        return diagnostics;
    }
    return {std::move(scan), std::move(diagnostics)};
}

}  // namespace kerf::bone
