// SPDX-License-Identifier: Apache-2.0
#include "core/import/image/read_image.h"

#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <exception>
#include <vector>

#include "core/import/image/image_file.h"

namespace kerf {
namespace {

itk::ImageIOBase::Pointer reader_for(ImageFile::Format format) {
    switch (format) {
        case ImageFile::Format::nrrd:
            return itk::NrrdImageIO::New().GetPointer();
        case ImageFile::Format::meta:
            return itk::MetaImageIO::New().GetPointer();
        default:
            return itk::NiftiImageIO::New().GetPointer();
    }
}

Diagnostic refused(const std::string& file, const char* code, std::string message) {
    Diagnostic wrong;
    wrong.code = code;
    wrong.place.file = file;
    wrong.message = std::move(message) + " Export the image again, for example as .nii.gz.";
    return wrong;
}

/// Whether ITK understood the header as we did: it must not take more memory than was checked for.
bool agrees(itk::ImageIOBase& io, const ImageFile& header) {
    // What NIfTI scales comes as a float.
    const bool is_scaled =
        header.format == ImageFile::Format::nifti && io.GetComponentType() == itk::IOComponentEnum::FLOAT;
    const bool has_type = is_scaled || io.GetComponentSize() == static_cast<unsigned>(header.bytes_per_voxel);
    if (io.GetNumberOfComponents() != static_cast<unsigned>(header.layers) || !has_type) return false;
    for (unsigned axis = 0; axis < io.GetNumberOfDimensions(); ++axis)
        if (io.GetDimensions(axis) != static_cast<std::size_t>(axis < 3 ? header.size[axis] : 1)) return false;
    return io.GetNumberOfDimensions() >= 3;
}

/// The voxels of a range and one layer, as floats.
template <class Stored>
std::vector<float> taken(const std::vector<char>& buffer, const VoxelGrid& grid, const VoxelRange& range, int layers,
                         int layer) {
    std::vector<float> values;
    values.reserve(range.voxels());
    for (int k = 0; k < range.size[2]; ++k)
        for (int j = 0; j < range.size[1]; ++j) {
            const std::size_t row = grid.offset(range.first[0], range.first[1] + j, range.first[2] + k);
            for (std::size_t i = 0; i < static_cast<std::size_t>(range.size[0]); ++i) {
                Stored value;
                std::memcpy(&value,
                            buffer.data() + ((row + i) * static_cast<std::size_t>(layers) +
                                             static_cast<std::size_t>(layer)) * sizeof value,
                            sizeof value);
                values.push_back(static_cast<float>(value));
            }
        }
    return values;
}

std::vector<float> taken(itk::IOComponentEnum type, const std::vector<char>& buffer, const VoxelGrid& grid,
                         const VoxelRange& range, int layers, int layer) {
    using Type = itk::IOComponentEnum;
    const auto as = [&]<class Stored>(Stored) { return taken<Stored>(buffer, grid, range, layers, layer); };
    switch (type) {
        case Type::UCHAR:
            return as(std::uint8_t{});
        case Type::CHAR:
            return as(std::int8_t{});
        case Type::USHORT:
            return as(std::uint16_t{});
        case Type::SHORT:
            return as(std::int16_t{});
        case Type::UINT:
            return as(std::uint32_t{});
        case Type::INT:
            return as(std::int32_t{});
        case Type::ULONG:
        case Type::ULONGLONG:
            return as(std::uint64_t{});
        case Type::LONG:
        case Type::LONGLONG:
            return as(std::int64_t{});
        case Type::FLOAT:
            return as(float{});
        case Type::DOUBLE:
            return as(double{});
        default:
            return {};
    }
}

std::optional<VoxelImage> read_with_itk(const std::string& file, const ImageFile& header, const VoxelRange& range,
                                        int layer, Diagnostics& diagnostics) {
    const itk::ImageIOBase::Pointer io = reader_for(header.format);
    io->SetFileName(file);
    io->ReadImageInformation();
    if (!agrees(*io, header)) {
        diagnostics.push_back(refused(file, "E0628", "the header can be understood in two ways."));
        return std::nullopt;
    }
    VoxelGrid grid;
    grid.size = header.size;
    if (!grid.place(header.lps_from_index)) {
        diagnostics.push_back(refused(file, "E0627", "the image's axes have no usable directions."));
        return std::nullopt;
    }
    itk::ImageIORegion all(io->GetNumberOfDimensions());
    for (unsigned axis = 0; axis < io->GetNumberOfDimensions(); ++axis) all.SetSize(axis, io->GetDimensions(axis));
    io->SetIORegion(all);
    std::vector<char> buffer(io->GetImageSizeInBytes());
    io->Read(buffer.data());

    VoxelImage image;
    static_cast<VoxelGrid&>(image) = grid.part(range);
    image.values = taken(io->GetComponentType(), buffer, grid, range, header.layers, layer);
    if (image.values.empty()) {
        diagnostics.push_back(refused(file, "E0625", "its type of voxel is not read."));
        return std::nullopt;
    }
    if (!std::all_of(image.values.begin(), image.values.end(), [](float v) { return std::isfinite(v); })) {
        diagnostics.push_back(refused(file, "E0629", "a voxel is no finite number."));
        return std::nullopt;
    }
    return image;
}

}  // namespace

std::optional<VoxelImage> read_image(const std::string& file, Diagnostics& diagnostics) {
    const std::optional<ImageFile> header = check_image_file(file, diagnostics);
    if (!header) return std::nullopt;
    if (header->layers > 1) {
        diagnostics.push_back(
            refused(file, "E0623", "there are " + std::to_string(header->layers) + " numbers per voxel, must be 1."));
        return std::nullopt;
    }
    return read_image(file, *header, {{0, 0, 0}, header->size}, 0, diagnostics);
}

std::optional<VoxelImage> read_image(const std::string& file, const ImageFile& header, const VoxelRange& range,
                                     int layer, Diagnostics& diagnostics) {
    itk::Object::GlobalWarningDisplayOff();  // what matters was checked, and is said in our words
    try {
        return read_with_itk(file, header, range, layer, diagnostics);
    } catch (const itk::ExceptionObject& error) {
        diagnostics.push_back(refused(file, "E0628", std::string("the reader says: ") + error.GetDescription()));
    } catch (const std::exception& error) {
        diagnostics.push_back(refused(file, "E0628", std::string("the reader says: ") + error.what()));
    }
    return std::nullopt;
}

}  // namespace kerf
