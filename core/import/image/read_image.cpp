// SPDX-License-Identifier: Apache-2.0
#include "core/import/image/read_image.h"

#include <itkImage.h>
#include <itkImageFileReader.h>
#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>

#include <algorithm>
#include <exception>

#include "core/import/image/image_file.h"

namespace kerf {
namespace {

using ItkImage = itk::Image<float, 3>;

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
    if (io.GetNumberOfComponents() != 1 || !has_type) return false;
    for (unsigned axis = 0; axis < io.GetNumberOfDimensions(); ++axis)
        if (io.GetDimensions(axis) != static_cast<std::size_t>(axis < 3 ? header.size[axis] : 1)) return false;
    return io.GetNumberOfDimensions() >= 3;
}

std::optional<VoxelImage> read_with_itk(const std::string& file, const ImageFile& header, Diagnostics& diagnostics) {
    const itk::ImageIOBase::Pointer io = reader_for(header.format);
    io->SetFileName(file);
    io->ReadImageInformation();
    if (!agrees(*io, header)) {
        diagnostics.push_back(refused(file, "E0628", "the header can be understood in two ways."));
        return std::nullopt;
    }
    const auto reader = itk::ImageFileReader<ItkImage>::New();
    reader->SetFileName(file);
    reader->SetImageIO(io);
    reader->Update();
    const ItkImage& itk_image = *reader->GetOutput();

    VoxelImage image;
    image.size = header.size;
    std::array<double, 12> lps_from_index;
    for (unsigned row = 0; row < 3; ++row) {
        for (unsigned axis = 0; axis < 3; ++axis)
            lps_from_index[4 * row + axis] = 1e-3 * itk_image.GetDirection()(row, axis) * itk_image.GetSpacing()[axis];
        lps_from_index[4 * row + 3] = 1e-3 * itk_image.GetOrigin()[row];
    }
    if (!image.place(lps_from_index)) {
        diagnostics.push_back(refused(file, "E0627", "the image's axes have no usable directions."));
        return std::nullopt;
    }
    const float* values = itk_image.GetBufferPointer();
    image.values.assign(values, values + header.voxels());
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
    itk::Object::GlobalWarningDisplayOff();  // what matters was checked, and is said in our words
    try {
        return read_with_itk(file, *header, diagnostics);
    } catch (const itk::ExceptionObject& error) {
        diagnostics.push_back(refused(file, "E0628", std::string("the reader says: ") + error.GetDescription()));
    } catch (const std::exception& error) {
        diagnostics.push_back(refused(file, "E0628", std::string("the reader says: ") + error.what()));
    }
    return std::nullopt;
}

}  // namespace kerf
