// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

/// Recognises files that a user gave to a command that cannot read them.
namespace kerf::text {

enum class FileKind {
    unknown,
    missing,
    folder,
    run_folder,  ///< has a session.db
    session,
    procedure,
    anatomy,
    station,
    scan,     ///< of voxels: NIfTI, NRRD, MetaImage, DICOM
    surface,  ///< a mesh: STL, PLY, OBJ
    page,     ///< HTML
    markdown,
    picture,
    pdf,
    archive,
    table,  ///< CSV
    json,
    shared_library,
    database,  ///< of SQLite, no session
};

/// What a file is, and which command reads it.
struct RecognisedFile {
    FileKind kind = FileKind::unknown;
    std::string name;    ///< "a session of Kerf"; empty if unknown or missing
    std::string advice;  ///< "Write `kerf view FILE` to see it."
};

/// Recognises a file by its first bytes, then by the ending of its name. A text whose ending is not known is unknown.
/// Opens regular files only. Never throws.   [main]
[[nodiscard]] RecognisedFile recognise(const std::string& file);

/// Returns "got a session of Kerf, expected a procedure. Write `kerf view FILE` to see it."; empty for a kind that
/// is unknown.   [any]
[[nodiscard]] std::string other_kind_text(const RecognisedFile& file, const std::string& expected);

}  // namespace kerf::text
