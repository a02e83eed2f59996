// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

/// Lists the personal data in a file.
namespace kerf::app {

struct PrivacyFinding {
    std::string what;   ///< "patient's name (0010,0010)", "a path"
    std::string value;  ///< shown only on request; empty: none
};

struct PrivacyReport {
    std::vector<PrivacyFinding> findings;
    std::vector<std::string> unseen;  ///< the parts that were not checked, a sentence each
    /// A part was not checked because it is damaged, too long, packed in an unknown form, or refused by the system.
    bool is_partial = false;
    std::string error;  ///< why the file cannot be read; empty if it can

    /// Adds a part that should have been checked, as a sentence.
    void add_unread(std::string part);
};

/// Searches a file for personal data.
///
/// | file | what is searched |
/// |---|---|
/// | DICOM | the elements that identify a person, in sequences too; other texts in sequences |
/// | NIfTI | the texts of the header; letters among the voxels |
/// | NRRD, MetaImage | the header; letters among the voxels, compressed or not |
/// | STL | the header |
/// | SQLite | the texts and the bytes of all tables |
/// | others | the text, as bytes and as UTF-16; in pages also base64 |
///
/// Text is searched for paths, the user and machine of this system, UIDs, dates, and names as DICOM writes them. The
/// start time of a session is no finding. Pictures are not interpreted: a face can be made of voxels. Memory is bounded
/// by a buffer, or by 500 MB of a text file. Never throws.   [main]
[[nodiscard]] PrivacyReport privacy_report(const std::string& file);

/// Returns the report for people, a line each finding. The first line of a partial report names it as that. Values are
/// masked after their first letter, unless `shows_values`.   [any]
[[nodiscard]] std::string privacy_text(const std::string& file, const PrivacyReport& report, bool shows_values);

}  // namespace kerf::app
