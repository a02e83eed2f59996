// SPDX-License-Identifier: Apache-2.0
#include "text/file_kind.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

#include "text/printable.h"
#include "text/regular_file.h"

namespace kerf::text {
namespace {

constexpr std::size_t max_head = 8192;                    // bytes that are read
constexpr std::size_t application_id_at = 68;             // in an SQLite file
constexpr std::string_view session_application = "KERF";  // 0x4B455246, as session/schema.h writes it

struct Kind {
    FileKind kind;
    const char* name;
    const char* advice;  ///< `{}` is the file
};

constexpr std::array kinds{
    Kind{FileKind::folder, "a folder", "Name a file in it."},
    Kind{FileKind::run_folder, "the folder of a run", "Write `kerf view {}/session.db` to see the run."},
    Kind{FileKind::session, "a session of Kerf", "Write `kerf view {}` to see it, or `kerf report {}` for its report."},
    Kind{FileKind::procedure, "a procedure", "Write `kerf validate {}` or `kerf run {}`."},
    Kind{FileKind::anatomy, "an anatomy", "Write `kerf anatomy check {}`, or name a procedure that uses it."},
    Kind{FileKind::station, "a station", "Give its name in KERF_STATION; `kerf devices` reads it."},
    Kind{FileKind::scan, "a scan", "Write `kerf import {}` to check it; an anatomy names it under `ct:`."},
    Kind{FileKind::surface, "a surface mesh", "Write `kerf import {}` to check it; an anatomy names it under `mesh:`."},
    Kind{FileKind::page, "a web page", "Open it in a browser, or name another file."},
    Kind{FileKind::markdown, "a text in Markdown", "Name another file."},
    Kind{FileKind::picture, "a picture", "Name another file."},
    Kind{FileKind::pdf, "a PDF", "Name another file."},
    Kind{FileKind::archive, "a compressed archive", "Unpack it, and name a file in it."},
    Kind{FileKind::table, "a table of values", "Name another file."},
    Kind{FileKind::json, "a file in JSON", "Name another file."},
    Kind{FileKind::shared_library, "a shared library", "Write `kerf check {}` if it is a plugin."},
    Kind{FileKind::database, "a database of SQLite without a session", "Name another file."},
};

std::string lower(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

std::string first_bytes(const std::string& file) {
    std::string head(max_head, '\0');
    std::ifstream stream = open_regular_file(file);
    stream.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
    return head;
}

FileKind kind_of_folder(const std::string& folder) {
    std::error_code error;
    return std::filesystem::is_regular_file(std::filesystem::path(folder) / "session.db", error) ? FileKind::run_folder
                                                                                                 : FileKind::folder;
}

FileKind kind_of_bytes(std::string_view head) {
    struct Start {
        std::string_view bytes;
        FileKind kind;
    };
    static constexpr std::array starts{
        Start{"\x89PNG", FileKind::picture},
        Start{"\xFF\xD8\xFF", FileKind::picture},
        Start{"GIF8", FileKind::picture},
        Start{"%PDF-", FileKind::pdf},
        Start{"PK\x03\x04", FileKind::archive},
        Start{"\x1F\x8B", FileKind::archive},
        Start{"\xFD"
              "7zXZ",
              FileKind::archive},
        Start{"\x7F"
              "ELF",
              FileKind::shared_library},
        Start{"NRRD000", FileKind::scan},
        Start{"ply\n", FileKind::surface},
        Start{"ply\r\n", FileKind::surface},
        Start{"solid ", FileKind::surface},
    };
    constexpr std::string_view sqlite = "SQLite format 3";
    if (head.starts_with(sqlite))
        return head.size() > application_id_at + 4 && head.substr(application_id_at, 4) == session_application
                   ? FileKind::session
                   : FileKind::database;
    if (head.size() > 132 && head.substr(128, 4) == "DICM") return FileKind::scan;
    for (const Start& start : starts)
        if (head.starts_with(start.bytes)) return start.kind;
    const std::string begin = lower(std::string(head.substr(0, 64)));
    return begin.starts_with("<!doctype html") || begin.starts_with("<html") ? FileKind::page : FileKind::unknown;
}

/// Returns the kind of a document in YAML: a line `kind: Anatomy`.
FileKind kind_of_document(std::string_view head) {
    struct Line {
        std::string_view text;
        FileKind kind;
    };
    static constexpr std::array lines{Line{"kind: Procedure", FileKind::procedure},
                                      Line{"kind: Anatomy", FileKind::anatomy},
                                      Line{"kind: Station", FileKind::station}};
    for (const Line& line : lines)
        if (head.starts_with(line.text) || head.find("\n" + std::string(line.text)) != std::string_view::npos)
            return line.kind;
    return FileKind::unknown;
}

FileKind kind_of_name(const std::string& file) {
    struct Ending {
        std::string_view text;
        FileKind kind;
    };
    static constexpr std::array endings{
        Ending{".nii", FileKind::scan},    Ending{".nii.gz", FileKind::scan}, Ending{".nrrd", FileKind::scan},
        Ending{".nhdr", FileKind::scan},   Ending{".mha", FileKind::scan},    Ending{".mhd", FileKind::scan},
        Ending{".dcm", FileKind::scan},    Ending{".stl", FileKind::surface}, Ending{".ply", FileKind::surface},
        Ending{".obj", FileKind::surface}, Ending{".html", FileKind::page},   Ending{".htm", FileKind::page},
        Ending{".svg", FileKind::picture}, Ending{".md", FileKind::markdown}, Ending{".csv", FileKind::table},
        Ending{".json", FileKind::json},
    };
    const std::string name = lower(file);
    for (const Ending& ending : endings)
        if (name.ends_with(ending.text)) return ending.kind;
    return FileKind::unknown;
}

FileKind kind_of(const std::string& file) {
    std::error_code error;
    const auto type = std::filesystem::status(file, error).type();
    if (type == std::filesystem::file_type::not_found) return FileKind::missing;
    if (type == std::filesystem::file_type::directory) return kind_of_folder(file);
    if (type != std::filesystem::file_type::regular) return FileKind::unknown;
    const std::string head = first_bytes(file);
    if (head.empty()) return FileKind::unknown;
    const FileKind by_bytes = kind_of_bytes(head);
    const FileKind by_name = kind_of_name(file);
    if (by_bytes == FileKind::archive && by_name == FileKind::scan) return by_name;  // .nii.gz
    if (by_bytes != FileKind::unknown) return by_bytes;
    const FileKind by_document = kind_of_document(head);
    return by_document != FileKind::unknown ? by_document : by_name;
}

std::string with_file(std::string_view advice, const std::string& file) {
    std::string text;
    for (std::size_t at = 0; at < advice.size();)
        if (advice.substr(at, 2) == "{}") {
            text += file;
            at += 2;
        } else {
            text += advice[at++];
        }
    return text;
}

}  // namespace

RecognisedFile recognise(const std::string& file) {
    const FileKind kind = kind_of(file);
    const auto* const found = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& k) { return k.kind == kind; });
    if (found == kinds.end()) return {kind, {}, {}};
    std::string name = printable(file);
    while (kind == FileKind::run_folder && name.size() > 1 && name.back() == '/') name.pop_back();
    return {kind, found->name, with_file(found->advice, name)};
}

std::string other_kind_text(const RecognisedFile& file, const std::string& expected) {
    if (file.name.empty()) return {};
    return "got " + file.name + ", expected " + expected + ". " + file.advice;
}

}  // namespace kerf::text
