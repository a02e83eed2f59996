// SPDX-License-Identifier: Apache-2.0
#include "bone/image/image_file.h"

#include <algorithm>
#include <exception>
#include <string_view>

#include "bone/image/header_checks.h"
#include "bone/image/header_fields.h"
#include "bone/image/packed_bytes.h"
#include "text/file_kind.h"

namespace kerf::bone {
namespace {

using header::refuse;
using header::refuse_truncated;

constexpr const char* copy_again = "Copy the file again, or correct the sizes in its header.";

/// Reports bytes beyond the size in the header. For a separate file and for packed voxels the length is the only check
/// of the sizes, so this is an error. In the header's own file other data may follow the voxels.
void doubt_rest(ImageFile& image, bool is_exact, const std::string& rest, const std::string& of) {
    const std::string more =
        " has " + rest + " bytes more than the " + std::to_string(image.data_bytes()) + " that the header's sizes need";
    if (is_exact) refuse("E0626", of + more + ".", copy_again);
    image.doubts.push_back("The file" + more + "; they were passed over.");
}

/// Unpacks all voxels without storing them, and checks their size, checksum and final length.
void check_packed(ImageFile& image) {
    const bool is_all = image.packing == ImageFile::Packing::gzip_file;
    const std::string of = is_all ? "unpacked, the file" : "unpacked, the block of voxels";
    PackedBytes bytes(image.data_file, is_all ? 0 : image.data_offset, PackedBytes::Packing::deflated);
    if (!bytes.is_open()) refuse("E0620", "the file cannot be opened.", "Check the permissions.");
    const std::uint64_t need = (is_all ? image.data_offset : 0) + image.data_bytes(), got = bytes.take(nullptr, need);
    if (bytes.is_damaged())
        refuse("E0626", "its compressed data are damaged after " + std::to_string(got) + " bytes.",
               "Copy the file again.");
    if (got < need) refuse_truncated(got, need, of);
    const std::uint64_t slice = image.data_bytes() / static_cast<std::uint64_t>(image.size[2]);
    const std::uint64_t rest = bytes.take(nullptr, slice);
    if (rest > 0 && !bytes.is_damaged())
        doubt_rest(image, !is_all, (rest == slice ? "at least " : "") + std::to_string(rest), of);
    switch (bytes.end()) {
        case PackedBytes::End::sound:
        case PackedBytes::End::more:  // already a doubt
            return;
        case PackedBytes::End::damaged:
            refuse("E0626", "the check sum or length at the end of its compressed data is wrong.",
                   "Copy the file again: some of its bytes have changed.");
        case PackedBytes::End::cut:
            refuse("E0626", "its compressed data end before their check sum.", "Copy the file again: it is cut short.");
    }
}

void check_bytes(ImageFile& image, const std::string& file) {
    const bool is_detached = image.data_file != file;
    const std::uint64_t size = header::size_of_file(image.data_file);
    if (image.packing == ImageFile::Packing::raw) {
        const std::uint64_t need = image.data_offset + image.data_bytes();
        if (size < need) refuse_truncated(size, need, "the file with the voxels");
        if (size > need) doubt_rest(image, is_detached, std::to_string(size - need), "the file with the voxels");
        return;
    }
    check_packed(image);  // its checksum was right, so a wrong size is only a doubt:
    if (image.packed_bytes != 0 && image.data_offset + image.packed_bytes != size)
        image.doubts.push_back("`CompressedDataSize` is " + std::to_string(image.packed_bytes) +
                               ", but the voxels take " + std::to_string(size - std::min(size, image.data_offset)) +
                               " bytes of the file.");
}

bool ends_in(const std::string& name, std::string_view ending) {
    return name.size() > ending.size() && name.ends_with(ending);
}

/// Returns why a file is neither a scan nor a surface.
std::string unknown_format(const std::string& file) {
    const text::RecognisedFile found = text::recognise(file);
    const bool is_other = !found.name.empty() && found.kind != text::FileKind::scan;
    return is_other ? "the file is of another kind: " + text::other_kind_text(found, "a scan or a surface")
                    : "the file's ending names no format that can be read.";
}

ImageFile checked(const std::string& file) {
    (void)header::size_of_file(file);
    const std::string name = header::lower(file);
    ImageFile image;
    if (ends_in(name, ".nii"))
        image = header::read_nifti(file, false);
    else if (ends_in(name, ".nii.gz"))
        image = header::read_nifti(file, true);
    else if (ends_in(name, ".nrrd") || ends_in(name, ".nhdr"))
        image = header::read_nrrd(file);
    else if (ends_in(name, ".mha") || ends_in(name, ".mhd"))
        image = header::read_meta(file);
    else
        refuse("E0621", unknown_format(file),
               "Use NIfTI (.nii, .nii.gz), NRRD (.nrrd, .nhdr) or MetaImage (.mha, .mhd); for a surface STL, OBJ or "
               "PLY.");
    check_bytes(image, file);
    return image;
}

}  // namespace

text::Result<ImageFile> check_image_file(const std::string& file) {
    try {
        return checked(file);
    } catch (const header::HeaderError& refusal) {
        return text::Diagnostics{text::error_about(file, refusal.code, refusal.message + " " + refusal.advice)};
    } catch (const std::exception& error) {  // out of memory, or an invalid path
        return text::Diagnostics{
            text::error_about(file, "E0620", std::string("the file cannot be checked: ") + error.what() + ".")};
    }
}

}  // namespace kerf::bone
