// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace kerf {

/// A DICOM file's outermost elements: short values as bytes, and where its voxels lie. What reads this never believes a
/// length: Debian's GDCM stops the program at a malformed header, so it never sees one.
class DicomElements {
public:
    struct Piece {
        std::uint64_t offset = 0, size = 0;  ///< [bytes] in the file
    };

    bool is_dicom = false;  ///< by the word DICM; or, in a file without a preamble, by its first group and its class
    std::string fault;      ///< why the elements cannot be as they say; empty: they can
    std::string encoding;   ///< UID of the transfer syntax
    bool is_big_endian = false;
    bool has_voxels = false;           ///< an element with pixel data
    bool is_encapsulated = false;      ///< they are compressed, in pieces of which the first is a table
    std::vector<Piece> voxels;         ///< one, or all fragments
    std::size_t private_elements = 0;  ///< of manufacturers: nobody else knows what they hold
    std::size_t sequences = 0;  ///< elements with elements in them, which are passed over unless somebody asks for them

    /// Whether the element is there at all, whatever it holds.
    [[nodiscard]] bool has(std::uint16_t group, std::uint16_t element) const;

    /// Without the blanks around it; empty if it is not there.
    [[nodiscard]] std::string text(std::uint16_t group, std::uint16_t element) const;

    /// Decimal strings, separated by backslashes. Empty if one of them is no finite number.
    [[nodiscard]] std::vector<double> numbers(std::uint16_t group, std::uint16_t element) const;

    /// The first of them.
    [[nodiscard]] std::optional<double> number(std::uint16_t group, std::uint16_t element) const;

    /// A whole number of 16 bits.
    [[nodiscard]] std::optional<int> word(std::uint16_t group, std::uint16_t element, bool is_signed = false) const;

private:
    friend DicomElements read_dicom_elements(const std::string& file,
                                             const std::function<void(std::uint32_t, const std::string*)>& nested);
    std::map<std::uint32_t, std::string> values_;
    std::vector<std::uint32_t> tags_;  ///< of all elements, in their order
};

/// What is to be done with an element within a sequence: its group and number, and its bytes; none if they are too many
/// to be a text.
using NestedDicomElement = std::function<void(std::uint32_t tag, const std::string* value)>;

/// Walks from element to element, up to the pixel data and over them. A length that goes beyond the file or its
/// own sequence is a fault: whoever believed it would take memory for bytes that are not there. Never throws.   [main]
/// @param nested   told of every element within a sequence, 16 deep at most; empty: sequences are passed over
[[nodiscard]] DicomElements read_dicom_elements(const std::string& file, const NestedDicomElement& nested = {});

}  // namespace kerf
