// SPDX-License-Identifier: Apache-2.0
// One DICOM file, from its elements to its voxels. The codecs of compressed pixels are left out: they are not ours, and
// run in a process that may crash (bone/image/dicom_codec.h).
#include "bone/image/dicom_elements.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

#include "bone/image/dicom_file.h"
#include "tests/fuzz/scratch_file.h"

bool kerf::fuzz::reads(std::string_view input) {
    static const ScratchFolder folder;
    const std::string file = folder.hold("slice.dcm", input);

    const bone::DicomElements elements = bone::read_dicom_elements(file);
    if (elements.is_dicom && elements.fault.empty())
        for (const bone::DicomElements::Piece& piece : elements.voxels)
            require(piece.offset <= input.size() && piece.size <= input.size() - piece.offset,
                    "voxels lie in the file");
    for (const std::uint16_t element : std::initializer_list<std::uint16_t>{0x0008, 0x0010, 0x0030, 0x0100, 0x1052}) {
        for (const double number : elements.numbers(0x0028, element))
            require(std::isfinite(number), "numbers are finite");
        (void)elements.word(0x0028, element, true);
    }

    const bone::DicomHeader header = bone::read_dicom_header(file);
    require((header.kind == bone::DicomHeader::Kind::other) == !elements.is_dicom, "what is DICOM is known as such");
    if (header.kind != bone::DicomHeader::Kind::slice || !header.trouble.empty()) return false;
    const bone::DicomSlice& slice = header.slice;
    require(is_finite(slice.origin) && std::isfinite(slice.slope) && std::isfinite(slice.intercept),
            "a slice has its place and scale");
    if (slice.is_compressed) return true;
    std::string trouble;
    const auto voxels = bone::read_dicom_voxels(slice, trouble);
    require(voxels.size() == static_cast<std::size_t>(slice.rows) * static_cast<std::size_t>(slice.columns),
            "a slice without trouble has all its voxels");
    require(std::none_of(voxels.begin(), voxels.end(), [](float value) { return std::isinf(value); }),
            "values are finite");
    return true;
}
