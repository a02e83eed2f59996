// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

/// What a file would tell of a person to whoever gets it.
namespace kerf {

struct PrivacyFinding {
    std::string what;   ///< "patient's name (0010,0010)", "a path"
    std::string value;  ///< not to be shown unless asked for; empty where there is none to show
};

struct PrivacyReport {
    std::vector<PrivacyFinding> findings;
    std::vector<std::string> unseen;  ///< what was not looked into, a sentence each
    std::string error;                ///< why the file cannot be read; empty if it can
};

/// Of a DICOM file: which elements that identify somebody have a value, in sequences too. Of NIfTI: the texts of its
/// header. Of all others (NRRD, MetaImage and STL by their headers, a database by its texts): whatever looks like a
/// path, a user or machine of this system, a UID, a person's name as DICOM writes it, or a date; as bytes or UTF-16.
/// The time at which a session's own run began is none of these. Voxels, packed or not, what a database holds as bytes
/// and a page as base64: the same, in plain letters. What voxels show is not looked at: a face can be made of them.
/// Memory is bounded: a buffer, or a text file of 500 MB. Never throws.   [main]
[[nodiscard]] PrivacyReport privacy_report(const std::string& file);

/// For people, a line each. Values are masked but for their first letter, unless they are to be shown.
[[nodiscard]] std::string privacy_text(const std::string& file, const PrivacyReport& report, bool shows_values);

}  // namespace kerf
