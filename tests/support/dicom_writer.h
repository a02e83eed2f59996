// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace kerf::test {

/// A DICOM file, element by element, that a test can spoil at one place. Explicit, little endian, unless `syntax` says
/// otherwise.
class DicomWriter {
public:
    using Tag = std::uint32_t;  ///< group << 16 | element

    DicomWriter& text(Tag tag, const char* sort, std::string value, char fill = ' ') {
        if (value.size() % 2 != 0) value.push_back(fill);
        elements_[tag] = {sort, std::move(value)};
        return *this;
    }
    DicomWriter& uid(Tag tag, std::string value) { return text(tag, "UI", std::move(value), '\0'); }
    DicomWriter& number(Tag tag, const std::vector<double>& values) {
        std::string all;
        for (const double value : values) all += (all.empty() ? "" : "\\") + decimal(value);
        return text(tag, "DS", all);
    }
    DicomWriter& word(Tag tag, int value, const char* sort = "US") {
        const auto raw = static_cast<std::uint16_t>(value);
        return text(tag, sort, std::string(reinterpret_cast<const char*>(&raw), 2));
    }
    DicomWriter& voxels(const std::vector<std::int16_t>& values) {
        elements_[0x7fe00010] = {"OW", std::string(reinterpret_cast<const char*>(values.data()), 2 * values.size())};
        return *this;
    }
    /// Compressed pixels: an empty table, then one fragment.
    DicomWriter& fragment(const std::string& encoding, std::string bytes) {
        syntax = encoding;
        if (bytes.size() % 2 != 0) bytes.push_back('\0');
        std::string value;
        const auto item = [&](std::uint16_t element, std::uint32_t length) {
            put(value, std::uint16_t{0xfffe});
            put(value, element);
            put(value, length);
        };
        item(0xe000, 0);
        item(0xe000, static_cast<std::uint32_t>(bytes.size()));
        value += bytes;
        item(0xe0dd, 0);
        elements_[0x7fe00010] = {"OB", value, true};
        return *this;
    }
    /// Bytes as they shall stand there: of a sequence, of something private.
    DicomWriter& raw(Tag tag, const char* sort, std::string value, bool is_open = false) {
        elements_[tag] = {sort, std::move(value), is_open};
        return *this;
    }
    DicomWriter& without(Tag tag) {
        elements_.erase(tag);
        return *this;
    }

    /// Its bytes as they were given; empty if it is not there.
    [[nodiscard]] std::string value(Tag tag) const {
        const auto found = elements_.find(tag);
        return found == elements_.end() ? std::string() : found->second.value;
    }

    std::string syntax =
        "1.2.840.10008.1.2.1";  ///< explicit; 1.2.840.10008.1.2 is implicit, 1.2.840.10008.1.2.2 big endian

    [[nodiscard]] std::string bytes() const {
        std::string group2;
        append(group2, 0x00020010, "UI", even(syntax), true);
        std::string all(128, '\0');
        all += "DICM";
        std::uint32_t length = static_cast<std::uint32_t>(group2.size());
        append(all, 0x00020000, "UL", std::string(reinterpret_cast<const char*>(&length), 4), true);
        all += group2;
        for (const auto& [tag, element] : elements_)
            append(all, tag, element.sort, element.value, syntax != "1.2.840.10008.1.2", element.is_open,
                   syntax == "1.2.840.10008.1.2.2");
        return all;
    }
    void write(const std::string& file) const { std::ofstream(file, std::ios::binary) << bytes(); }

    static std::string decimal(double value) {
        char text[32];
        const auto end = std::to_chars(text, text + sizeof text, value);
        return {text, end.ptr};
    }

private:
    struct Element {
        std::string sort, value;
        bool is_open = false;  ///< of undefined length: the value holds its own end
    };
    static std::string even(std::string value) {
        if (value.size() % 2 != 0) value.push_back('\0');
        return value;
    }
    template <class Number>
    static void put(std::string& out, Number value, bool is_big = false) {
        std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
        if (is_big) std::reverse(bytes.begin(), bytes.end());
        out += bytes;
    }
    static void append(std::string& out, Tag tag, const std::string& sort, std::string value, bool is_explicit,
                       bool is_open = false, bool is_big = false) {
        put(out, static_cast<std::uint16_t>(tag >> 16), is_big);
        put(out, static_cast<std::uint16_t>(tag), is_big);
        const auto length = is_open ? 0xffffffffu : static_cast<std::uint32_t>(value.size());
        if (!is_explicit) {
            put(out, length, is_big);
        } else {
            out += sort;
            const bool is_long = sort == "OW" || sort == "OB" || sort == "SQ" || sort == "UN" || sort == "UT";
            if (is_long) {
                put(out, std::uint16_t{0});
                put(out, length, is_big);
            } else {
                put(out, static_cast<std::uint16_t>(length), is_big);
            }
        }
        if (is_big && (sort == "US" || sort == "SS" || sort == "OW"))
            for (std::size_t at = 0; at + 1 < value.size(); at += 2) std::swap(value[at], value[at + 1]);
        out += value;
    }

    std::map<Tag, Element> elements_;
};

/// Tags that tests speak of.
namespace tag {
inline constexpr DicomWriter::Tag image_type = 0x00080008, sop_class = 0x00080016, sop_instance = 0x00080018,
                                  modality = 0x00080060, patient_name = 0x00100010, gantry_tilt = 0x00181120,
                                  study = 0x0020000d, series = 0x0020000e, series_number = 0x00200011,
                                  acquisition = 0x00200012, instance = 0x00200013, position = 0x00200032,
                                  orientation = 0x00200037, frame_of_reference = 0x00200052, samples = 0x00280002,
                                  photometric = 0x00280004, frames = 0x00280008, rows = 0x00280010,
                                  columns = 0x00280011, pixel_spacing = 0x00280030, bits_allocated = 0x00280100,
                                  bits_stored = 0x00280101, high_bit = 0x00280102, representation = 0x00280103,
                                  padding = 0x00280120, padding_limit = 0x00280121, intercept = 0x00281052,
                                  slope = 0x00281053, lossy = 0x00282110, pixel_data = 0x7fe00010;
}  // namespace tag

/// A CT slice with everything that a reader needs: `values` are HU, stored as HU + 1024.
inline DicomWriter ct_slice(int columns, int rows, double spacing_mm, std::vector<double> position_mm, int instance,
                            const std::vector<int>& hounsfield) {
    DicomWriter file;
    file.uid(tag::sop_class, "1.2.840.10008.5.1.4.1.1.2")
        .uid(tag::sop_instance, "1.2.3.4." + std::to_string(instance))
        .text(tag::modality, "CS", "CT")
        .text(tag::image_type, "CS", "ORIGINAL\\PRIMARY\\AXIAL")
        .uid(tag::study, "1.2.3")
        .uid(tag::series, "1.2.3.4")
        .text(tag::series_number, "IS", "4")
        .text(tag::instance, "IS", std::to_string(instance))
        .number(tag::position, position_mm)
        .number(tag::orientation, {1, 0, 0, 0, 1, 0})
        .uid(tag::frame_of_reference, "1.2.3.5")
        .word(tag::samples, 1)
        .text(tag::photometric, "CS", "MONOCHROME2")
        .word(tag::rows, rows)
        .word(tag::columns, columns)
        .number(tag::pixel_spacing, {spacing_mm, spacing_mm})
        .word(tag::bits_allocated, 16)
        .word(tag::bits_stored, 16)
        .word(tag::high_bit, 15)
        .word(tag::representation, 0)
        .number(tag::intercept, {-1024})
        .number(tag::slope, {1});
    std::vector<std::int16_t> stored;
    for (const int value : hounsfield) stored.push_back(static_cast<std::int16_t>(value + 1024));
    return file.voxels(stored);
}

}  // namespace kerf::test
