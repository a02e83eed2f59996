// SPDX-License-Identifier: Apache-2.0
#include "core/import/image/dicom_file.h"

#include <gdcmImageReader.h>
#include <gdcmReader.h>
#include <gdcmTrace.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "core/import/image/dicom_layout.h"

namespace kerf {
namespace {

constexpr int least_edge = 2, most_edge = 4096;               // [voxels]
constexpr double least_spacing = 1e-6, most_spacing = 100e-3;  // [m]
constexpr double straight = 1e-3;                              // [–] of a unit vector

/// Why a slice cannot be used.
struct Trouble {
    std::string what;
};

/// The elements that are asked for, as text and numbers, whatever the locale.
class Elements {
public:
    explicit Elements(const gdcm::DataSet& set) : set_(set) {}

    [[nodiscard]] std::string text(std::uint16_t group, std::uint16_t element) const {
        const gdcm::Tag tag(group, element);
        if (!set_.FindDataElement(tag)) return {};
        const gdcm::ByteValue* value = set_.GetDataElement(tag).GetByteValue();
        if (value == nullptr || value->GetPointer() == nullptr) return {};
        std::string text(value->GetPointer(), value->GetLength());
        const auto is_blank = [](char c) { return c == ' ' || c == '\0'; };
        while (!text.empty() && is_blank(text.back())) text.pop_back();
        text.erase(text.begin(), std::find_if_not(text.begin(), text.end(), is_blank));
        return text;
    }

    /// Decimal strings, separated by backslashes. Empty if one of them is no finite number.
    [[nodiscard]] std::vector<double> numbers(std::uint16_t group, std::uint16_t element) const {
        const std::string all = text(group, element);
        std::vector<double> values;
        for (std::size_t at = 0; at < all.size();) {
            const std::size_t end = std::min(all.find('\\', at), all.size());
            const char *first = all.data() + at, *last = all.data() + end;
            while (first < last && (*first == ' ' || *first == '+')) ++first;
            while (last > first && last[-1] == ' ') --last;
            double value = 0.0;
            const auto read = std::from_chars(first, last, value);
            if (read.ec != std::errc{} || read.ptr != last || !std::isfinite(value)) return {};
            values.push_back(value);
            at = end + 1;
        }
        return values;
    }

    /// The one number of a decimal string.
    [[nodiscard]] std::optional<double> number(std::uint16_t group, std::uint16_t element) const {
        const auto values = numbers(group, element);
        return values.empty() ? std::nullopt : std::optional(values.front());
    }

    /// A whole number of 16 bits, in this machine's order: the reader has turned it.
    [[nodiscard]] std::optional<int> word(std::uint16_t group, std::uint16_t element, bool is_signed = false) const {
        const gdcm::Tag tag(group, element);
        if (!set_.FindDataElement(tag)) return std::nullopt;
        const gdcm::ByteValue* value = set_.GetDataElement(tag).GetByteValue();
        std::uint16_t raw = 0;
        if (value == nullptr || value->GetLength() < sizeof raw) return std::nullopt;
        std::copy_n(value->GetPointer(), sizeof raw, reinterpret_cast<char*>(&raw));
        return is_signed ? static_cast<int>(static_cast<std::int16_t>(raw)) : static_cast<int>(raw);
    }

private:
    const gdcm::DataSet& set_;
};

int whole(std::optional<double> number) {
    return number && std::abs(*number) < 1e9 ? static_cast<int>(std::lround(*number)) : 0;
}

bool is_unit(Vec3 v) { return std::abs(length(v) - 1.0) < straight; }

void read_place(const Elements& of, DicomSlice& slice) {
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
        if (!(s >= least_spacing && s <= most_spacing))
            throw Trouble{"its pixel spacing is outside 0.001 mm … 100 mm"};
    if (const auto tilt = of.number(0x0018, 0x1120)) slice.tilt = *tilt * 3.14159265358979323846 / 180.0;
}

void read_values(const Elements& of, const DicomLayout& layout, DicomSlice& slice) {
    slice.rows = of.word(0x0028, 0x0010).value_or(0);
    slice.columns = of.word(0x0028, 0x0011).value_or(0);
    for (const int n : {slice.rows, slice.columns})
        if (n < least_edge || n > most_edge)
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
    if (!layout.is_encapsulated && layout.voxel_bytes < need)
        throw Trouble{"it has " + std::to_string(layout.voxel_bytes) + " bytes of pixels, its size needs " +
                      std::to_string(need)};

    slice.slope = of.number(0x0028, 0x1053).value_or(1.0);
    slice.intercept = of.number(0x0028, 0x1052).value_or(0.0);
    if (slice.slope == 0.0) throw Trouble{"its rescale slope (0028,1053) is 0"};
    slice.padding = of.word(0x0028, 0x0120, slice.is_signed);
}

void read_sort(const Elements& of, DicomSlice& slice) {
    slice.series = of.text(0x0020, 0x000e);
    slice.frame_of_reference = of.text(0x0020, 0x0052);
    slice.series_number = whole(of.number(0x0020, 0x0011));
    slice.instance = whole(of.number(0x0020, 0x0013));
    const std::string modality = of.text(0x0008, 0x0060);
    const auto is_capital = [](char c) { return c >= 'A' && c <= 'Z'; };
    if (modality.size() == 2 && std::all_of(modality.begin(), modality.end(), is_capital)) slice.modality = modality;
    slice.is_localizer = of.text(0x0008, 0x0008).find("LOCALIZER") != std::string::npos;
    slice.is_lossy = of.text(0x0028, 0x2110) == "01";
}

/// The library's own words are for its developers, and may repeat what stands in the file.
void silence() {
    gdcm::Trace::DebugOff();
    gdcm::Trace::WarningOff();
    gdcm::Trace::ErrorOff();
}

/// A raw value of the given bits, moved down and its sign spread.
std::int32_t unpacked(std::uint32_t raw, const DicomSlice& slice) {
    const int shift = slice.high_bit + 1 - slice.bits_stored;
    const std::uint32_t mask = slice.bits_stored == 32 ? ~0u : (1u << slice.bits_stored) - 1u;
    std::uint32_t value = (raw >> shift) & mask;
    const bool is_negative = slice.is_signed && (value >> (slice.bits_stored - 1) & 1u) != 0;
    if (is_negative) value |= ~mask;
    return static_cast<std::int32_t>(value);
}

std::vector<float> decoded(const DicomSlice& slice) {
    silence();
    gdcm::ImageReader reader;
    reader.SetFileName(slice.file.c_str());
    if (!reader.Read()) throw Trouble{"its pixels are compressed in a way that cannot be decoded, or damaged"};
    const gdcm::Image& image = reader.GetImage();
    const std::size_t count = static_cast<std::size_t>(slice.rows) * static_cast<std::size_t>(slice.columns);
    const std::size_t bytes = static_cast<std::size_t>(slice.bits_allocated / 8);
    if (image.GetNumberOfDimensions() < 2 || image.GetDimension(0) != static_cast<unsigned>(slice.columns) ||
        image.GetDimension(1) != static_cast<unsigned>(slice.rows) || image.GetBufferLength() != count * bytes)
        throw Trouble{"its pixels are of another size than its header says"};
    std::vector<char> buffer(count * bytes);
    if (!image.GetBuffer(buffer.data()))
        throw Trouble{"its pixels are compressed in a way that cannot be decoded, or damaged"};

    std::vector<float> values(count);
    for (std::size_t at = 0; at < count; ++at) {
        std::uint32_t raw = 0;
        std::copy_n(buffer.data() + at * bytes, bytes, reinterpret_cast<char*>(&raw));
        const std::int32_t value = unpacked(raw, slice);
        const double scaled = slice.slope * (slice.is_signed ? static_cast<double>(value)
                                                             : static_cast<double>(static_cast<std::uint32_t>(value))) +
                              slice.intercept;
        values[at] = slice.padding == value ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(scaled);
    }
    return values;
}

}  // namespace

DicomHeader read_dicom_header(const std::string& file) {
    DicomHeader header;
    const DicomLayout layout = dicom_layout(file);
    if (!layout.is_dicom) return header;
    header.kind = DicomHeader::Kind::damaged;
    header.trouble = layout.fault;
    if (!layout.fault.empty()) return header;
    header.kind = DicomHeader::Kind::no_slice;
    if (!layout.has_voxels) return header;
    header.kind = DicomHeader::Kind::slice;
    header.slice.file = file;
    if (layout.encoding == "1.2.840.10008.1.2.1.99") {
        header.trouble = "all of it is deflated";
        return header;
    }
    try {
        silence();
        gdcm::Reader reader;
        reader.SetFileName(file.c_str());
        if (!reader.ReadUpToTag(gdcm::Tag(0x7fe0, 0x0010))) throw Trouble{"its header cannot be read"};
        const Elements elements(reader.GetFile().GetDataSet());
        read_sort(elements, header.slice);
        read_place(elements, header.slice);
        read_values(elements, layout, header.slice);
    } catch (const Trouble& trouble) {
        header.trouble = trouble.what;
    } catch (const std::exception&) {
        header.trouble = "its header cannot be read";
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

}  // namespace kerf
