// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace kerf::bone {

/// An element that may identify a person, and has a value.
struct DicomIdentityElement {
    std::string name;   ///< "patient's name (0010,0010)"
    std::string value;  ///< not empty
    bool is_in_sequence = false;
};

/// The contents of a DICOM file that may identify a person.
struct DicomIdentity {
    std::vector<DicomIdentityElement> elements;
    bool has_text_in_picture = false;  ///< as the file itself states
    std::size_t private_elements = 0;  ///< of manufacturers, in sequences too
    std::string nested_texts;          ///< values of all other elements in sequences, each with a line end
    bool has_all_nested_texts = true;  ///< false: `nested_texts` ends after 16 MB
    std::size_t unread_elements = 0;   ///< in sequences; too long for a text
    bool is_deflated = false;          ///< the elements after the first group are compressed, and were not read
    std::string fault;                 ///< of the outermost elements; empty: none
    std::string sequence_fault;        ///< of a sequence; empty: none
};

/// Reads the elements that PS3.15, table E.1-1, removes or replaces: names, numbers, dates and texts of people. Reads
/// sequences too. A file that is no DICOM gives an empty result. Never throws.   [main]
[[nodiscard]] DicomIdentity read_dicom_identity(const std::string& file);

}  // namespace kerf::bone
