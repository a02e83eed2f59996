// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace kerf::bone {

/// The outermost elements of a DICOM file: short values as bytes, and the position of its voxels. The reader checks
/// every length before use. Debian's GDCM aborts at a malformed header, so it never gets one.
class DicomElements {
public:
    struct Piece {
        std::uint64_t offset = 0, size = 0;  ///< [bytes] in the file
    };

    bool is_dicom = false;  ///< by the word DICM; without a preamble, by the first group and the class
    std::string fault;      ///< defect of the elements; empty if none
    std::string encoding;   ///< UID of the transfer syntax
    bool is_big_endian = false;
    bool has_voxels = false;           ///< the file has pixel data
    bool is_encapsulated = false;      ///< compressed, in fragments of which the first is a table
    std::vector<Piece> voxels;         ///< one piece, or all fragments
    std::size_t private_elements = 0;  ///< of manufacturers, with undocumented contents
    std::size_t sequences = 0;         ///< elements with elements inside, which are skipped without a `nested` callback

    /// Returns whether the element exists, with any value.
    [[nodiscard]] bool has(std::uint16_t group, std::uint16_t element) const;

    /// Returns the value without surrounding blanks; empty if the element is missing.
    [[nodiscard]] std::string text(std::uint16_t group, std::uint16_t element) const;

    /// Returns the decimal strings, which backslashes separate; empty if one of them is not a finite number.
    [[nodiscard]] std::vector<double> numbers(std::uint16_t group, std::uint16_t element) const;

    /// Returns the first decimal string as a number.
    [[nodiscard]] std::optional<double> number(std::uint16_t group, std::uint16_t element) const;

    /// Returns the value as a 16-bit integer.
    [[nodiscard]] std::optional<int> word(std::uint16_t group, std::uint16_t element, bool is_signed = false) const;

private:
    friend DicomElements read_dicom_elements(const std::string& file,
                                             const std::function<void(std::uint32_t, const std::string*)>& nested);
    std::map<std::uint32_t, std::string> values_;
    std::vector<std::uint32_t> tags_;  ///< of all elements, in their order
};

/// Callback for an element within a sequence: its group and number, and its bytes; null if the value is too long for
/// text.
using NestedDicomElement = std::function<void(std::uint32_t tag, const std::string* value)>;

/// Reads the elements up to and including the pixel data. A length beyond the end of the file or of its sequence is a
/// fault, so a false length allocates no memory. Never throws.   [main]
/// @param nested  called for every element within a sequence, 16 deep at most; empty: sequences are skipped
[[nodiscard]] DicomElements read_dicom_elements(const std::string& file, const NestedDicomElement& nested = {});

}  // namespace kerf::bone
