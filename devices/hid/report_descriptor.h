// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

/// The report descriptor of a HID device: which bits of which report mean what.
namespace kerf::hid {

enum class ReportKind : std::uint8_t { input, output, feature };

/// A usage with its page: page in the upper 16 bits.
using Usage = std::uint32_t;
constexpr Usage usage_of(std::uint16_t page, std::uint16_t id) noexcept { return Usage{page} << 16u | id; }

struct UsageRange {
    Usage first = 0, last = 0;
};

/// One main item: `count` elements of `bit_size` bits each.
struct ReportField {
    static constexpr std::size_t no_collection = std::numeric_limits<std::size_t>::max();

    ReportKind kind = ReportKind::input;
    std::uint8_t report_id = 0;    ///< 0: the device has no ids
    std::uint32_t bit_offset = 0;  ///< [bits] of the first element, without the byte of the id
    std::uint32_t bit_size = 0;    ///< [bits] of an element, 1 to 32
    std::uint32_t count = 0;       ///< of elements
    bool is_constant = false;      ///< padding
    bool is_variable = false;      ///< each element has a usage; else its value is an index into the usages
    bool is_relative = false;      ///< a value is a change
    std::int64_t logical_min = 0, logical_max = 0;
    std::int64_t physical_min = 0, physical_max = 0;  ///< both 0: as the logical ones
    std::uint32_t unit = 0;                           ///< code of HID 1.11, 6.2.2.7; 0: none
    int unit_exponent = 0;                            ///< power of ten
    std::vector<UsageRange> usages{};
    std::size_t collection = no_collection;  ///< innermost one

    /// Returns the usage at an index, the last one for larger indices; 0 if there is none.
    [[nodiscard]] Usage usage_at(std::size_t index) const noexcept;
    /// Returns the index of the first element or value with a usage; -1 if none has it.
    [[nodiscard]] std::int64_t index_of(Usage usage) const noexcept;
};

struct ReportCollection {
    Usage usage = 0;
    std::size_t parent = ReportField::no_collection;
};

struct ReportDescriptor {
    std::vector<ReportField> fields{};
    std::vector<ReportCollection> collections{};
    bool has_ids = false;
    std::array<std::array<std::uint32_t, 256>, 3> bits{};  ///< [bits] of the reports, by kind and id

    /// Returns the size of a report [bytes], with the byte of its id if the device has ids; 0: there is none.
    [[nodiscard]] std::size_t size_of(ReportKind kind, std::uint8_t id) const noexcept;
    /// Returns whether a field is in a collection with a usage, at any depth.
    [[nodiscard]] bool is_within(const ReportField& field, Usage collection) const noexcept;
    /// Returns whether there is a collection with a usage.
    [[nodiscard]] bool has_collection(Usage usage) const noexcept;
};

struct ParsedDescriptor {
    ReportDescriptor descriptor{};
    std::string problem{};  ///< why it is refused, with the byte; empty: it is sound
};

/// Reads a report descriptor of at most 4096 bytes, with reports of at most 1024 bytes.   [any] pure
///
/// A unit exponent of one nibble is signed, as devices write it. A logical maximum is unsigned unless the minimum is
/// negative. Of alternative usages between delimiters the first one counts.
///
/// Source: Device Class Definition for HID 1.11, 6.2.2.
[[nodiscard]] ParsedDescriptor parse_descriptor(std::span<const std::uint8_t> bytes);

}  // namespace kerf::hid
