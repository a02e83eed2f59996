// SPDX-License-Identifier: Apache-2.0
#include "bone/image/dicom_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <fstream>
#include <limits>
#include <optional>
#include <utility>

#include "bone/image/dicom_codec.h"
#include "bone/image/dicom_elements.h"
#include "text/regular_file.h"

namespace kerf::bone {
namespace {

constexpr int min_edge = 2, max_edge = 4096;                // [voxels]
constexpr double min_spacing = 1e-6, max_spacing = 100e-3;  // [m]
constexpr double max_scale = 1e9;                           // [–] with it 32-bit values still fit a float
constexpr double straight = 1e-3;                           // [–] deviation from a unit vector

/// Reason why a slice cannot be used.
struct Trouble {
    std::string what;
};

int whole(std::optional<double> number) {
    return number && std::abs(*number) < 1e9 ? static_cast<int>(std::lround(*number)) : 0;
}

bool is_unit(Vec3 v) { return std::abs(length(v) - 1.0) < straight; }

/// Checks that the pixels can be decoded.
void check_encoding(const DicomElements& of) {
    static constexpr std::array<const char*, 3> plain{"1.2.840.10008.1.2", "1.2.840.10008.1.2.1",
                                                      "1.2.840.10008.1.2.2"};
    const bool is_plain = std::find(plain.begin(), plain.end(), of.encoding) != plain.end();
    if (!is_plain && !can_unpack(of.encoding))
        throw Trouble{"it is encoded in a way that cannot be read; plain, run length, JPEG, JPEG-LS and JPEG 2000 can"};
    if (is_plain == of.is_encapsulated) throw Trouble{"its pixels are not encoded as its header says"};
}

void read_geometry(const DicomElements& of, DicomSlice& slice) {
    const auto at = of.numbers(0x0020, 0x0032), axes = of.numbers(0x0020, 0x0037), spacing = of.numbers(0x0028, 0x0030);
    if (at.size() != 3) throw Trouble{"it has no position (0020,0032)"};
    if (axes.size() != 6) throw Trouble{"it has no orientation (0020,0037)"};
    if (spacing.size() != 2) throw Trouble{"it has no pixel spacing (0028,0030)"};
    slice.origin = 1e-3 * Vec3{at[0], at[1], at[2]};
    slice.along_row = {axes[0], axes[1], axes[2]};
    slice.down_column = {axes[3], axes[4], axes[5]};
    slice.between_rows = 1e-3 * spacing[0];
    slice.between_columns = 1e-3 * spacing[1];
    if (!is_unit(slice.along_row) || !is_unit(slice.down_column) ||
        std::abs(dot(slice.along_row, slice.down_column)) > straight)
        throw Trouble{"its orientation (0020,0037) is no pair of unit vectors at right angles"};
    if (length(slice.origin) > 100.0) throw Trouble{"its position is more than 100 m away"};
    for (const double s : {slice.between_rows, slice.between_columns})
        if (!(s >= min_spacing && s <= max_spacing)) throw Trouble{"its pixel spacing is outside 0.001 mm … 100 mm"};
    if (const auto ratio = of.numbers(0x0028, 0x0034);
        ratio.size() == 2 &&
        std::abs(ratio[0] * spacing[1] - ratio[1] * spacing[0]) > 1e-2 * std::abs(ratio[0] * spacing[1]))
        throw Trouble{"its pixel spacing (0028,0030) and aspect ratio (0028,0034) differ"};
    if (const auto step = of.number(0x0018, 0x0088)) slice.between_slices = 1e-3 * std::abs(*step);
    if (const auto tilt = of.number(0x0018, 0x1120)) slice.tilt = *tilt * 3.14159265358979323846 / 180.0;
}

/// Reads the padding: one value (0028,0120), or the range between it and a second one (0028,0121), in either order.
void read_padding(const DicomElements& of, DicomSlice& slice) {
    const auto one = of.word(0x0028, 0x0120, slice.is_signed), other = of.word(0x0028, 0x0121, slice.is_signed);
    if (other && !one) throw Trouble{"it has a limit of padding (0028,0121) without its value (0028,0120)"};
    if (one) slice.padding = {std::min(*one, other.value_or(*one)), std::max(*one, other.value_or(*one))};
}

void read_values(const DicomElements& of, DicomSlice& slice) {
    slice.rows = of.word(0x0028, 0x0010).value_or(0);
    slice.columns = of.word(0x0028, 0x0011).value_or(0);
    for (const int n : {slice.rows, slice.columns})
        if (n < min_edge || n > max_edge)
            throw Trouble{"it has " + std::to_string(slice.columns) + " × " + std::to_string(slice.rows) +
                          " pixels, must have 2 … 4096 each way"};
    if (const int samples = of.word(0x0028, 0x0002).value_or(1); samples != 1)
        throw Trouble{"it has " + std::to_string(samples) + " numbers per pixel, must have 1"};
    if (whole(of.number(0x0028, 0x0008)) > 1) throw Trouble{"it holds several frames"};
    if (const std::string sort = of.text(0x0028, 0x0004); sort != "MONOCHROME2")
        throw Trouble{"its pixels are not MONOCHROME2"};

    slice.bits_allocated = of.word(0x0028, 0x0100).value_or(0);
    slice.bits_stored = of.word(0x0028, 0x0101).value_or(slice.bits_allocated);
    slice.high_bit = of.word(0x0028, 0x0102).value_or(slice.bits_stored - 1);
    slice.is_signed = of.word(0x0028, 0x0103).value_or(0) == 1;
    const bool has_bits = (slice.bits_allocated == 8 || slice.bits_allocated == 16 || slice.bits_allocated == 32) &&
                          slice.bits_stored >= 1 && slice.bits_stored <= slice.bits_allocated &&
                          slice.high_bit + 1 >= slice.bits_stored && slice.high_bit < slice.bits_allocated;
    if (!has_bits) throw Trouble{"its bits per pixel are not 8, 16 or 32, or do not fit together"};
    const std::uint64_t need = static_cast<std::uint64_t>(slice.rows) * static_cast<std::uint64_t>(slice.columns) *
                               static_cast<std::uint64_t>(slice.bits_allocated / 8);
    const std::uint64_t odd = need % 2;  // a DICOM value has an even length
    if (!of.is_encapsulated && (of.voxels.front().size < need || of.voxels.front().size > need + odd))
        throw Trouble{"it has " + std::to_string(of.voxels.front().size) + " bytes of pixels, its size needs " +
                      std::to_string(need)};
    slice.encoding = of.encoding;
    slice.is_big_endian = of.is_big_endian;
    slice.is_compressed = of.is_encapsulated;
    slice.voxels = of.voxels;

    const auto rescale = [&](std::uint16_t element, double otherwise) {
        const auto value = of.number(0x0028, element);
        if (!value && !of.text(0x0028, element).empty()) throw Trouble{"its rescale slope or intercept is no number"};
        return value.value_or(otherwise);
    };
    slice.slope = rescale(0x1053, 1.0);
    slice.intercept = rescale(0x1052, 0.0);
    if (slice.slope == 0.0) throw Trouble{"its rescale slope (0028,1053) is 0"};
    if (std::abs(slice.slope) > max_scale || std::abs(slice.intercept) > max_scale)
        throw Trouble{"its rescale slope (0028,1053) or intercept (0028,1052) is beyond 1000000000"};
    read_padding(of, slice);
    // A lookup table is not a linear function of the stored values.
    if (of.has(0x0028, 0x3000)) throw Trouble{"its values come out of a table (0028,3000), which is not read"};
}

void read_sort(const DicomElements& of, DicomSlice& slice) {
    slice.series = of.text(0x0020, 0x000e);
    slice.frame_of_reference = of.text(0x0020, 0x0052);
    slice.series_number = whole(of.number(0x0020, 0x0011));
    slice.instance = whole(of.number(0x0020, 0x0013));
    slice.acquisition = whole(of.number(0x0020, 0x0012));
    // Temporal position, echo, voltage, kernel. Two blanks separate them, because none contains two.
    for (const auto& [group, element] :
         {std::pair{0x0020, 0x0100}, {0x0018, 0x0086}, {0x0018, 0x0060}, {0x0018, 0x1210}})
        slice.pass += of.text(static_cast<std::uint16_t>(group), static_cast<std::uint16_t>(element)) + "  ";
    for (const auto& [group, element] : {std::pair{0x0008, 0x0022}, {0x0008, 0x0032}, {0x0008, 0x002a}})
        slice.acquired_at += of.text(static_cast<std::uint16_t>(group), static_cast<std::uint16_t>(element)) + "  ";
    const std::string values = of.text(0x0028, 0x1054);
    if (values.size() <= 16 && std::all_of(values.begin(), values.end(), [&](char c) {
            return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
        }))
        slice.values = values;
    const std::string modality = of.text(0x0008, 0x0060);
    const auto is_capital = [](char c) { return c >= 'A' && c <= 'Z'; };
    if (modality.size() == 2 && std::all_of(modality.begin(), modality.end(), is_capital)) slice.modality = modality;
    slice.is_localizer = of.text(0x0008, 0x0008).find("LOCALIZER") != std::string::npos;
    slice.is_lossy = of.text(0x0028, 0x2110) == "01";
}

/// Returns the stored bits of a raw value, shifted down and sign-extended.
std::int32_t unpacked(std::uint32_t raw, const DicomSlice& slice) {
    const int shift = slice.high_bit + 1 - slice.bits_stored;
    const std::uint32_t mask = slice.bits_stored == 32 ? ~0u : (1u << slice.bits_stored) - 1u;
    std::uint32_t value = (raw >> shift) & mask;
    const bool is_negative = slice.is_signed && (value >> (slice.bits_stored - 1) & 1u) != 0;
    if (is_negative) value |= ~mask;
    return static_cast<std::int32_t>(value);
}

std::string bytes_of(std::ifstream& in, const DicomElements::Piece& piece, std::uint64_t most) {
    std::string bytes(std::min(piece.size, most), '\0');
    in.seekg(static_cast<std::streamoff>(piece.offset));
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!in) throw Trouble{"its pixels cannot be read"};
    return bytes;
}

/// Returns the pixels as rows × columns × bits_allocated / 8 bytes, least significant first.
std::vector<char> raw_pixels(const DicomSlice& slice) {
    std::ifstream in = text::open_regular_file(slice.file);
    if (slice.is_compressed) {
        std::vector<std::string> fragments;
        for (std::size_t n = 1; n < slice.voxels.size(); ++n)
            fragments.push_back(bytes_of(in, slice.voxels[n], slice.voxels[n].size));
        std::vector<char> pixels = fragments.empty() ? std::vector<char>() : unpacked_pixels(slice, fragments);
        if (pixels.empty()) throw Trouble{"its pixels are damaged, or compressed in a way that cannot be unpacked"};
        return pixels;
    }
    const std::size_t bytes = static_cast<std::size_t>(slice.bits_allocated / 8);
    const std::string stored =
        bytes_of(in, slice.voxels.front(),
                 static_cast<std::uint64_t>(slice.rows) * static_cast<std::uint64_t>(slice.columns) * bytes);
    std::vector<char> pixels(stored.begin(), stored.end());
    if (slice.is_big_endian)
        for (auto at = pixels.begin(); at != pixels.end(); at += static_cast<std::ptrdiff_t>(bytes))
            std::reverse(at, at + static_cast<std::ptrdiff_t>(bytes));
    return pixels;
}

std::vector<float> decoded(const DicomSlice& slice) {
    const std::vector<char> buffer = raw_pixels(slice);
    const std::size_t count = static_cast<std::size_t>(slice.rows) * static_cast<std::size_t>(slice.columns);
    const std::size_t bytes = static_cast<std::size_t>(slice.bits_allocated / 8);
    std::vector<float> values(count);
    for (std::size_t at = 0; at < count; ++at) {
        std::uint32_t raw = 0;
        std::copy_n(buffer.data() + at * bytes, bytes, reinterpret_cast<char*>(&raw));
        const std::int32_t value = unpacked(raw, slice);
        const double scaled = slice.slope * (slice.is_signed ? static_cast<double>(value)
                                                             : static_cast<double>(static_cast<std::uint32_t>(value))) +
                              slice.intercept;
        // Unsigned 32-bit values may be negative here. Padding has 16 bits at most.
        const bool is_padding = slice.padding && value >= slice.padding->low && value <= slice.padding->high;
        values[at] = is_padding ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(scaled);
    }
    return values;
}

}  // namespace

DicomHeader read_dicom_header(const std::string& file) {
    DicomHeader header;
    const DicomElements elements = read_dicom_elements(file);
    if (!elements.is_dicom) return header;
    header.kind = DicomHeader::Kind::damaged;
    header.trouble = elements.fault;
    if (!elements.fault.empty()) return header;
    header.kind = DicomHeader::Kind::no_slice;
    if (!elements.has_voxels) return header;
    header.kind = DicomHeader::Kind::slice;
    header.slice.file = file;
    try {
        read_sort(elements, header.slice);
        check_encoding(elements);
        read_values(elements, header.slice);
        read_geometry(elements, header.slice);
    } catch (const Trouble& trouble) {
        header.trouble = trouble.what;
    }
    return header;
}

std::vector<float> read_dicom_voxels(const DicomSlice& slice, std::string& trouble) {
    try {
        return decoded(slice);
    } catch (const Trouble& found) {
        trouble = found.what;
    } catch (const std::exception&) {
        trouble = "its pixels cannot be read";
    }
    return {};
}

}  // namespace kerf::bone
