// SPDX-License-Identifier: Apache-2.0
#include "app/privacy.h"

#include <pwd.h>
#include <sqlite3.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "bone/image/dicom_elements.h"
#include "bone/image/packed_bytes.h"
#include "session/packed_column.h"
#include "session/recorder.h"

namespace kerf {
namespace {

constexpr std::size_t max_findings = 20;  // of one kind, of one file
constexpr std::uintmax_t max_bytes = 500'000'000;
constexpr std::uint64_t max_unpacked = 4'000'000'000;
constexpr std::size_t max_nested_text = 16'000'000;

// ---- DICOM
// ------------------------------------------------------------------------------------------------------------

struct Tag {
    std::uint16_t group, element;
    const char* name;
};

/// What PS3.15, table E.1-1 takes out or replaces, as far as it stands outside of sequences and is a name, a number, a
/// date or a text of people.
constexpr Tag identifying[] = {
    {0x0008, 0x0012, "date of the file"},
    {0x0008, 0x0014, "UID of who made the file"},
    {0x0008, 0x0018, "UID of the picture"},
    {0x0008, 0x0020, "date of the study"},
    {0x0008, 0x0021, "date of the series"},
    {0x0008, 0x0022, "date of acquisition"},
    {0x0008, 0x0023, "date of the picture"},
    {0x0008, 0x002a, "time of acquisition"},
    {0x0008, 0x0030, "time of the study"},
    {0x0008, 0x0050, "accession number"},
    {0x0008, 0x0080, "institution"},
    {0x0008, 0x0081, "institution's address"},
    {0x0008, 0x0090, "referring physician"},
    {0x0008, 0x0092, "referring physician's address"},
    {0x0008, 0x0094, "referring physician's telephone"},
    {0x0008, 0x1010, "station"},
    {0x0008, 0x1030, "description of the study"},
    {0x0008, 0x103e, "description of the series"},
    {0x0008, 0x1040, "department"},
    {0x0008, 0x1048, "physician of record"},
    {0x0008, 0x1050, "performing physician"},
    {0x0008, 0x1060, "reading physician"},
    {0x0008, 0x1070, "operator"},
    {0x0008, 0x1080, "admitting diagnosis"},
    {0x0008, 0x2111, "how the picture was derived"},
    {0x0010, 0x0010, "patient's name"},
    {0x0010, 0x0020, "patient's number"},
    {0x0010, 0x0021, "who gave the patient's number"},
    {0x0010, 0x0030, "date of birth"},
    {0x0010, 0x0032, "time of birth"},
    {0x0010, 0x0040, "sex"},
    {0x0010, 0x1000, "other numbers of the patient"},
    {0x0010, 0x1001, "other names of the patient"},
    {0x0010, 0x1005, "birth name"},
    {0x0010, 0x1010, "age"},
    {0x0010, 0x1020, "size"},
    {0x0010, 0x1030, "weight"},
    {0x0010, 0x1040, "patient's address"},
    {0x0010, 0x1060, "mother's birth name"},
    {0x0010, 0x1090, "number of the medical record"},
    {0x0010, 0x2000, "medical alerts"},
    {0x0010, 0x2110, "allergies"},
    {0x0010, 0x2154, "patient's telephone"},
    {0x0010, 0x2160, "ethnic group"},
    {0x0010, 0x2180, "occupation"},
    {0x0010, 0x21b0, "patient's history"},
    {0x0010, 0x4000, "comments on the patient"},
    {0x0018, 0x1000, "serial number of the device"},
    {0x0018, 0x1030, "protocol"},
    {0x0018, 0x1400, "description of the device's processing"},
    {0x0020, 0x000d, "UID of the study"},
    {0x0020, 0x000e, "UID of the series"},
    {0x0020, 0x0010, "number of the study"},
    {0x0020, 0x0052, "UID of the frame of reference"},
    {0x0020, 0x4000, "comments on the picture"},
    {0x0032, 0x1032, "requesting physician"},
    {0x0032, 0x1033, "requesting department"},
    {0x0032, 0x1060, "description of the request"},
    {0x0038, 0x0010, "number of the admission"},
    {0x0038, 0x0300, "patient's ward"},
    {0x0038, 0x0500, "patient's state"},
    {0x0040, 0x0244, "date of the procedure"},
    {0x0040, 0x0253, "number of the procedure"},
    {0x0040, 0x0254, "description of the procedure"},
    {0x0040, 0xa075, "who verified"},
    {0x0040, 0xa123, "person"},
};

std::string tag_text(const Tag& tag) {
    char text[64];
    std::snprintf(text, sizeof text, " (%04x,%04x)", static_cast<unsigned>(tag.group),
                  static_cast<unsigned>(tag.element));
    return tag.name + std::string(text);
}

/// Once only, and no more than a few of a kind.
void add_finding(PrivacyReport& report, const std::string& what, std::string value) {
    const auto same = [&](const PrivacyFinding& f) { return f.what == what && f.value == value; };
    const auto kind = [&](const PrivacyFinding& f) { return f.what == what; };
    auto& all = report.findings;
    if (std::any_of(all.begin(), all.end(), same) ||
        std::count_if(all.begin(), all.end(), kind) >= static_cast<std::ptrdiff_t>(max_findings))
        return;
    all.push_back({what, std::move(value)});
}

// ---- text
// -------------------------------------------------------------------------------------------------------------

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
}
bool is_word(char c) { return is_digit(c) || is_letter(c) || c == '_'; }
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Users and machine that this system goes by; short ones would be found everywhere.
std::vector<std::string> names_of_this_system() {
    std::vector<std::string> names;
    if (const passwd* user = getpwuid(getuid()); user != nullptr && user->pw_name != nullptr)
        names.emplace_back(user->pw_name);
    char host[256] = {};
    if (gethostname(host, sizeof host - 1) == 0) names.emplace_back(host);
    std::erase_if(names, [](const std::string& name) {
        return name.size() < 4 || name == "root" || name == "localhost" || name == "user";
    });
    return names;
}

class Looking {
public:
    /// @param where   stands behind what is found; not empty: the text was picked out of bytes, where letters also come
    /// by chance
    Looking(const std::string& text, PrivacyReport& report, std::string where = "")
        : text_(text), report_(report), where_(std::move(where)) {}

    void all() {
        for (const std::string& name : names_) find_word(name, "the name of this system's user or machine");
        for (const char* key : {"PatientName", "PatientID", "patient_name", "patient_id"})
            find_word(key, "a field for a patient");
        for (std::size_t at = 0; at < text_.size(); ++at) {
            const char c = text_[at];
            if (c == '/' || c == '\\')
                path(at);
            else if (c == '^')
                person(at);
            else if (is_digit(c) && (at == 0 || (!is_word(text_[at - 1]) && text_[at - 1] != '.')))
                number(at);
        }
    }

private:
    void add(const char* what, std::size_t from, std::size_t end) {
        add_finding(report_, what + where_, text_.substr(from, std::min<std::size_t>(end - from, 200)));
    }
    [[nodiscard]] char at(std::size_t n) const { return n < text_.size() ? text_[n] : '\0'; }

    void find_word(const std::string& word, const char* what) {
        const auto same = [](char a, char b) { return lower(a) == lower(b); };
        for (auto from = text_.begin();;) {
            const auto found = std::search(from, text_.end(), word.begin(), word.end(), same);
            if (found == text_.end()) return;
            const auto begin = static_cast<std::size_t>(found - text_.begin());
            if ((begin == 0 || !is_word(text_[begin - 1])) && !is_word(at(begin + word.size())))
                add(what, begin, begin + word.size());
            from = found + 1;
        }
    }
    /// Where people and systems keep files, as in /home/jane/scan or C:\Users\jane.
    void path(std::size_t slash) {
        static constexpr std::array<const char*, 11> roots{"home/", "Users/",   "root/",   "tmp/", "mnt/", "media/",
                                                           "var/",  "Volumes/", "Users\\", "srv/", "work/"};
        if (slash > 0 && (is_word(text_[slash - 1]) || text_[slash - 1] == '/' || text_[slash - 1] == '.'))
            return;  // within a longer path, or an address
        for (const char* root : roots) {
            const std::string_view word(root);
            if (text_.compare(slash + 1, word.size(), word) != 0) continue;
            std::size_t end = slash + 1 + word.size();
            if (!is_word(at(end))) return;
            while (end < text_.size() && static_cast<unsigned char>(text_[end]) > 0x20 && text_[end] != '"' &&
                   text_[end] != '\'' && text_[end] != '<')
                ++end;
            add("a path", slash, end);
        }
    }
    /// Family^Given, as DICOM writes people.
    void person(std::size_t caret) {
        std::size_t from = caret, end = caret + 1;
        while (from > 0 && (is_letter(text_[from - 1]) || text_[from - 1] == '-')) --from;
        while (is_letter(at(end)) || at(end) == '-') ++end;
        // Of a hundred million bytes that mean nothing a few look like that
        if (!where_.empty() && (!is_name(from, caret) || !is_name(caret + 1, end) || !stands_alone(from, end) ||
                                is_row_of_numbers(from, end)))
            return;
        if (caret - from >= 2 && end - caret > 2) add("a person's name as DICOM writes it", from, end);
    }
    /// Three letters or more, `Doe` or `DOE`, and nothing between.
    [[nodiscard]] bool is_name(std::size_t from, std::size_t end) const {
        const auto is_capital = [&](std::size_t n) { return text_[n] >= 'A' && text_[n] <= 'Z'; };
        if (end - from < 3 || !is_capital(from)) return false;
        for (std::size_t n = from + 2; n < end; ++n)
            if (is_capital(n) != is_capital(from + 1)) return false;
        return true;
    }
    /// Bounded as a value is, in a header or a text, by a length, a tag, a space, a quotation mark.
    [[nodiscard]] bool stands_alone(std::size_t from, std::size_t end) const {
        const auto bounds = [](char c) {
            return static_cast<unsigned char>(c) <= 0x20 ||
                   std::string_view("\"'<>=:;,^\\").find(c) != std::string_view::npos;
        };
        return (from == 0 || bounds(text_[from - 1])) && bounds(at(end));
    }
    /// Every second byte the same, or every fourth from before to behind: numbers of two or four bytes each, such as
    /// corners of triangles.
    [[nodiscard]] bool is_row_of_numbers(std::size_t from, std::size_t end) const {
        for (const std::size_t first : {from, from + 1}) {
            bool is_same = true;
            for (std::size_t n = first + 2; n < end; n += 2) is_same = is_same && text_[n] == text_[first];
            if (is_same) return true;
        }
        for (std::size_t n = std::max<std::size_t>(from, 4); n < from + 4; ++n)
            if (text_[n - 4] == text_[n] && at(n + 4) == text_[n]) return true;
        return false;
    }
    /// A UID (six numbers or more with points between them), 2024-05-17, or 20240517.
    void number(std::size_t from) {
        std::size_t end = from, points = 0;
        while (is_digit(at(end)) || (at(end) == '.' && is_digit(at(end + 1)))) points += text_[end++] == '.';
        if (points >= 5) return add("a UID", from, end);
        const auto value = [&](std::size_t begin, std::size_t count) {
            int number = 0;
            for (std::size_t n = begin; n < begin + count; ++n)
                number = is_digit(at(n)) ? 10 * number + (text_[n] - '0') : 100'000;
            return number;
        };
        const auto is_date = [&](std::size_t month, std::size_t day) {
            return value(from, 4) >= 1900 && value(from, 4) < 2100 && value(month, 2) >= 1 && value(month, 2) <= 12 &&
                   value(day, 2) >= 1 && value(day, 2) <= 31;
        };
        if (end - from == 8 && points == 0 && !is_word(at(end)) && is_date(from + 4, from + 6))
            add("a date", from, end);
        if (end - from == 4 && at(end) == '-' && at(end + 3) == '-' && is_date(from + 5, from + 8) &&
            !is_digit(at(end + 6)))
            add("a date", from, from + 10);
    }

    const std::string& text_;
    PrivacyReport& report_;
    const std::string where_;
    const std::vector<std::string> names_ = names_of_this_system();
};

/// What is written with two bytes a letter.
std::string out_of_utf16(const std::string& bytes) {
    std::string text;
    for (std::size_t at = 0; at + 1 < bytes.size();) {
        const bool is_pair = bytes[at] >= 0x20 && bytes[at] < 0x7f && bytes[at + 1] == '\0';
        text += is_pair ? bytes[at] : '\0';
        at += is_pair ? 2 : 1;
    }
    return text;
}

void look_at_text(const std::string& bytes, PrivacyReport& report) {
    Looking(bytes, report).all();
    const std::string wide = out_of_utf16(bytes);
    Looking(wide, report).all();
}

// ---- bytes that are no text
// -------------------------------------------------------------------------------------------

/// Voxels, triangles, pictures: only what stands among them as eight plain letters or more in a row is looked at.
/// However many bytes come, no more is kept than a few megabytes of that.
class LookingAmongBytes {
public:
    LookingAmongBytes(PrivacyReport& report, std::string where) : report_(report), where_(std::move(where)) {}

    void take(std::string_view bytes) {
        for (const char c : bytes) {
            const bool is_plain = c >= 0x20 && c < 0x7f;
            if (is_plain) run_ += c;
            if (!is_plain || run_.size() >= max_in_row) keep_run(is_plain);
        }
    }
    void end() {
        keep_run(false);
        look();
    }

private:
    static constexpr std::size_t min_in_row = 8, max_in_row = 1 << 20, overlap = 1 << 12, max_kept = 4 << 20;

    /// What may go on in the next piece of a long row is looked at there again.
    void keep_run(bool goes_on) {
        if (run_.size() >= min_in_row) kept_ += run_ + '\n';
        if (goes_on)
            run_.erase(0, run_.size() - overlap);
        else
            run_.clear();
        if (kept_.size() > max_kept) look();
    }
    void look() {
        Looking(kept_, report_, where_).all();
        kept_.clear();
    }

    PrivacyReport& report_;
    const std::string where_;
    std::string run_, kept_;
};

/// The rest of a file that may be packed, a buffer at a time.
void look_at_voxels(PackedBytes& bytes, PrivacyReport& report) {
    LookingAmongBytes looking(report, ", among the voxels");
    std::string buffer(1 << 18, '\0');
    std::uint64_t sum = 0;
    while (sum < max_unpacked) {
        const std::uint64_t count = bytes.take(buffer.data(), buffer.size());
        looking.take(std::string_view(buffer).substr(0, count));
        sum += count;
        if (count < buffer.size()) break;
    }
    looking.end();
    if (bytes.is_damaged())
        report.unseen.push_back("The packed voxels are damaged, and were not looked at to their end.");
    if (sum >= max_unpacked) report.unseen.push_back("Only the first 4 GB of the voxels were looked at.");
    report.unseen.push_back("Among the voxels only plain letters were looked for: not those of two bytes each, and not "
                            "what a picture of them shows.");
}

/// What pages hold as base64: surfaces, pictures.
void look_at_base64(const std::string& text, PrivacyReport& report) {
    constexpr std::size_t least = 64;  // letters; shorter ones are words
    const auto digit = [](char c) {
        return c >= 'A' && c <= 'Z'   ? c - 'A'
               : c >= 'a' && c <= 'z' ? c - 'a' + 26
               : is_digit(c)          ? c - '0' + 52
               : c == '+'             ? 62
               : c == '/'             ? 63
                                      : -1;
    };
    LookingAmongBytes looking(report, ", in base64");
    for (std::size_t from = 0; from < text.size();) {
        std::size_t end = from;
        while (end < text.size() && digit(text[end]) >= 0) ++end;
        if (end - from >= least) {
            std::uint32_t bits = 0;
            int count = 0;
            for (std::size_t at = from; at < end; ++at) {
                bits = bits << 6 | static_cast<std::uint32_t>(digit(text[at]));
                if ((count += 6) < 8) continue;
                count -= 8;
                const char byte = static_cast<char>(bits >> count & 0xffu);
                looking.take({&byte, 1});
            }
            looking.take(std::string_view("\0", 1));
        }
        from = end + 1;
    }
    looking.end();
}

// ---- DICOM, all of it
// -------------------------------------------------------------------------------------------------

void look_at_dicom(const std::string& file, PrivacyReport& report) {
    const DicomElements elements = read_dicom_elements(file);
    for (const Tag& tag : identifying)
        if (std::string value = elements.text(tag.group, tag.element); !value.empty())
            report.findings.push_back({tag_text(tag), std::move(value)});
    if (elements.text(0x0028, 0x0301) == "YES")
        report.findings.push_back({"writing within the picture (0028,0301)", ""});

    // A walk of its own: where a sequence is wrong, it ends
    std::size_t nested_private = 0, too_long = 0;
    std::string texts;
    bool is_all_kept = true;
    const auto look_at = [&](std::uint32_t tag, const std::string* value) {
        if ((tag >> 16) % 2 != 0) ++nested_private;
        if (value == nullptr) return void(++too_long);
        const auto known = std::find_if(std::begin(identifying), std::end(identifying), [&](const Tag& t) {
            return (std::uint32_t{t.group} << 16 | t.element) == tag;
        });
        if (known != std::end(identifying)) {
            const std::string plain = value->substr(0, value->find_last_not_of(std::string_view(" \0", 2)) + 1);
            if (!plain.empty()) add_finding(report, tag_text(*known) + ", in a sequence", plain);
            return;
        }
        is_all_kept = is_all_kept && texts.size() < max_nested_text;
        if (is_all_kept) texts += *value + '\n';
    };
    const DicomElements nested = read_dicom_elements(file, look_at);
    LookingAmongBytes looking(report, ", in a sequence");
    looking.take(texts);
    looking.end();
    if (const std::size_t all = elements.private_elements + nested_private; all > 0)
        report.findings.push_back(
            {std::to_string(all) + " private elements, of which only the manufacturer knows what they hold", ""});

    if (too_long > 0)
        report.unseen.push_back(std::to_string(too_long) + " long elements of sequences were not looked at.");
    if (!is_all_kept) report.unseen.push_back("Of the texts in sequences only the first 16 MB were looked at.");
    if (elements.encoding == "1.2.840.10008.1.2.1.99")
        report.unseen.push_back("All that follows its first elements is packed, and was not looked at.");
    if (!elements.fault.empty())
        report.unseen.push_back("The file is damaged: " + elements.fault + ". What follows was not looked at.");
    else if (!nested.fault.empty())
        report.unseen.push_back("A sequence is damaged: " + nested.fault +
                                ". Sequences behind it were not looked into.");
}

// ---- databases
// --------------------------------------------------------------------------------------------------------

/// Whether a text is written as `pattern` is: 0 stands for a digit, f for a hexadecimal one.
bool is_written_as(std::string_view text, std::string_view pattern) {
    const auto fits = [](char want, char got) {
        const bool is_hex = is_digit(got) || (got >= 'a' && got <= 'f');
        return want == '0' ? is_digit(got) : want == 'f' ? is_hex : want == got;
    };
    return text.size() == pattern.size() && std::equal(pattern.begin(), pattern.end(), text.begin(), fits);
}

/// Whether a row of a session's envelope is what Kerf itself puts there: when the run began, by its own clock, and its
/// random number. They are the session's own, and tell nothing of whose bone it was. Whatever else stands in their
/// place is looked at.
bool is_of_the_run(const std::string& key, const std::string& value) {
    return (key == "start" && is_written_as(value, "0000-00-00T00:00:00Z")) ||
           (key == "uuid" && is_written_as(value, "ffffffff-ffff-ffff-ffff-ffffffffffff"));
}

/// Whether a row of a session's table `blocks` holds numbers alone: what its bytes would look like means nothing.
bool is_packed_column(sqlite3_stmt* row, ColumnUnpacker& unpacker, std::vector<std::uint64_t>& cells) {
    constexpr int rows_column = 2, differences_column = 4, data_column = 5;
    if (sqlite3_column_count(row) != data_column + 1) return false;
    const auto rows = static_cast<std::uint64_t>(sqlite3_column_int64(row, rows_column));
    if (rows > max_block_rows || sqlite3_column_type(row, data_column) != SQLITE_BLOB) return false;
    cells.resize(rows);
    const std::span<const unsigned char> bytes(static_cast<const unsigned char*>(sqlite3_column_blob(row, data_column)),
                                               static_cast<std::size_t>(sqlite3_column_bytes(row, data_column)));
    const int differences = sqlite3_column_int(row, differences_column);
    return unpacker.unpack(bytes, differences, NumberFormat::float64, cells) ||
           unpacker.unpack(bytes, differences, NumberFormat::float32, cells);
}

/// All texts of all tables, each on a line of its own; numbers would look like anything. Bytes are looked at here.
/// Empty, and `is_whole` false, if it is damaged.
std::string texts_of_database(const std::string& file, bool& is_whole, PrivacyReport& report) {
    sqlite3* raw = nullptr;
    is_whole = sqlite3_open_v2(file.c_str(), &raw, SQLITE_OPEN_READONLY, nullptr) == SQLITE_OK;
    const std::unique_ptr<sqlite3, int (*)(sqlite3*)> database(raw, &sqlite3_close);
    std::string all;
    const auto each_row = [&](const std::string& sql, const auto& take) {
        sqlite3_stmt* statement = nullptr;
        int code = sqlite3_prepare_v2(raw, sql.c_str(), -1, &statement, nullptr);
        while (code == SQLITE_OK || code == SQLITE_ROW)
            if (code = sqlite3_step(statement); code == SQLITE_ROW) take(statement);
        is_whole = is_whole && code == SQLITE_DONE;
        sqlite3_finalize(statement);
    };
    LookingAmongBytes among_bytes(report, ", among bytes");
    ColumnUnpacker unpacker;
    std::vector<std::uint64_t> cells;
    std::vector<std::string> tables;
    const auto text_of = [](sqlite3_stmt* row, int column) {
        const auto* bytes = static_cast<const char*>(sqlite3_column_blob(row, column));
        return bytes == nullptr ? std::string()
                                : std::string(bytes, static_cast<std::size_t>(sqlite3_column_bytes(row, column)));
    };
    bool is_session = false;
    if (is_whole)
        each_row("PRAGMA application_id",
                 [&](sqlite3_stmt* row) { is_session = sqlite3_column_int64(row, 0) == session_application_id; });
    if (is_whole)
        each_row("SELECT name, sql FROM sqlite_master WHERE type = 'table' AND sql LIKE 'CREATE TABLE %'",
                 [&](sqlite3_stmt* row) {
                     tables.push_back(text_of(row, 0));
                     all += text_of(row, 1) + "\n";
                 });
    for (const std::string& table : tables) {
        std::string quoted;
        for (const char c : table) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
        each_row("SELECT * FROM \"" + quoted + "\"", [&](sqlite3_stmt* row) {
            if (is_session && table == "envelope" && sqlite3_column_count(row) == 2 &&
                is_of_the_run(text_of(row, 0), text_of(row, 1)))
                return;
            const bool is_numbers = is_session && table == "blocks" && is_packed_column(row, unpacker, cells);
            for (int column = 0; column < sqlite3_column_count(row); ++column)
                if (const int type = sqlite3_column_type(row, column); type == SQLITE_TEXT)
                    all += text_of(row, column) + "\n";
                else if (type == SQLITE_BLOB && !is_numbers)
                    among_bytes.take(text_of(row, column) + '\0');
        });
    }
    among_bytes.end();
    return all;
}

// ---- headers
// ----------------------------------------------------------------------------------------------------------

bool ends_in(const std::string& name, std::string_view ending) {
    return name.size() >= ending.size() &&
           std::equal(ending.begin(), ending.end(), name.end() - static_cast<std::ptrdiff_t>(ending.size()),
                      [](char want, char got) { return want == lower(got); });
}

void look_at_nifti(const std::string& file, PrivacyReport& report) {
    std::string header(348, '\0');
    const auto packing = ends_in(file, ".gz") ? PackedBytes::Packing::deflated : PackedBytes::Packing::none;
    PackedBytes bytes(file, 0, packing);
    header.resize(bytes.take(header.data(), header.size()));
    if (header.size() < 348) return void(report.error = file + ": is no NIfTI file. Check its name.");
    struct Field {
        std::size_t at, size;
        const char* name;
    };
    for (const Field& field : {Field{4, 10, "`data_type`"}, Field{14, 18, "`db_name`"}, Field{148, 80, "`descrip`"},
                               Field{228, 24, "`aux_file`"}, Field{328, 16, "`intent_name`"}}) {
        const std::string value = header.substr(field.at, field.size).c_str();
        if (!value.empty()) report.findings.push_back({std::string("text in the header's ") + field.name, value});
    }
    look_at_voxels(bytes, report);  // and the header's extensions before them
}

bool is_dicom(const std::string& file) { return read_dicom_elements(file).is_dicom; }

/// The value of a header's line, as in `encoding: gzip` or `CompressedData = True`, in lower case.
std::string header_value(const std::string& header, std::string_view key) {
    for (std::size_t at = 0; at < header.size();) {
        const std::size_t end = std::min(header.find('\n', at), header.size());
        std::string line = header.substr(at, end - at);
        at = end + 1;
        for (char& c : line) c = lower(c);
        if (line.compare(0, key.size(), key) != 0) continue;
        line.erase(0, key.size());
        line.erase(0, std::min(line.find_first_not_of(" :="), line.size()));
        return line.substr(0, line.find_last_not_of(" \r") + 1);
    }
    return {};
}

/// The voxels behind a header of NRRD or MetaImage in the same file.
void look_behind_header(const std::string& file, const std::string& header, std::uint64_t offset, bool is_nrrd,
                        PrivacyReport& report) {
    const std::string encoding = is_nrrd                                            ? header_value(header, "encoding")
                                 : header_value(header, "compresseddata") == "true" ? "gzip"
                                                                                    : "raw";
    const bool is_packed = encoding == "gzip" || encoding == "gz";
    if (!is_packed && encoding != "raw" && encoding != "ascii" && encoding != "text" && encoding != "txt")
        return report.unseen.push_back("The voxels are packed in another way than gzip, and were not looked at.");
    if (!header_value(header, "data file").empty() || !header_value(header, "datafile").empty())
        report.unseen.push_back("The voxels are in another file. Name that one, too.");
    PackedBytes bytes(file, offset, is_packed ? PackedBytes::Packing::deflated : PackedBytes::Packing::none);
    look_at_voxels(bytes, report);
}

}  // namespace

PrivacyReport privacy_report(const std::string& file) {
    PrivacyReport report;
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) {
        report.error = file + ": there is no such file. Name files one by one; of a series its slices.";
        return report;
    }
    if (is_dicom(file)) {
        look_at_dicom(file, report);
        return report;
    }
    if (ends_in(file, ".nii") || ends_in(file, ".nii.gz")) {
        look_at_nifti(file, report);
        return report;
    }
    char first[16] = {};
    if (std::ifstream(file, std::ios::binary).read(first, sizeof first) &&
        std::string_view(first, 15) == "SQLite format 3") {
        bool is_whole = true;
        look_at_text(texts_of_database(file, is_whole, report), report);
        report.unseen.push_back(is_whole ? "What was deleted in the database was not looked at."
                                         : "The database is damaged, and was not looked at to its end.");
        return report;
    }
    const bool is_nrrd = ends_in(file, ".nrrd") || ends_in(file, ".nhdr"), is_stl = ends_in(file, ".stl"),
               is_meta = ends_in(file, ".mha");
    std::ifstream in(file, std::ios::binary);
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    const std::uintmax_t wanted = is_stl ? 84 : is_nrrd || is_meta ? 65'536 : max_bytes;
    std::string bytes(std::min(size, wanted), '\0');
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!in || error) {
        report.error = file + ": cannot be read. Check its permissions.";
        return report;
    }
    if (is_nrrd || is_meta) {
        // The header ends with an empty line, or with the line that says where the voxels are.
        const std::size_t data = bytes.find("ElementDataFile");
        const std::size_t last = is_nrrd                     ? std::min(bytes.find("\n\n"), bytes.find("\n\r\n"))
                                 : data == std::string::npos ? data
                                                             : bytes.find('\n', data);
        const std::size_t end = last == std::string::npos ? bytes.size()
                                : is_nrrd                 ? bytes.find('\n', last + 1) + 1
                                                          : last + 1;
        bytes.resize(end);
    }
    look_at_text(bytes, report);
    if (is_nrrd || is_meta)
        look_behind_header(file, bytes, bytes.size(), is_nrrd, report);
    else if (!is_stl)
        look_at_base64(bytes, report);
    else
        report.unseen.push_back("Behind an STL's first 84 bytes nothing was looked at.");
    if (size > max_bytes && !is_stl && !is_nrrd && !is_meta)
        report.unseen.push_back("Only the first 500 MB were looked at.");
    return report;
}

std::string privacy_text(const std::string& file, const PrivacyReport& report, bool shows_values) {
    std::string text = file + ": " +
                       (report.findings.empty()
                            ? "nothing that tells of a person was found"
                            : std::to_string(report.findings.size()) +
                                  (report.findings.size() == 1 ? " thing tells" : " things tell") + " of a person") +
                       "\n";
    const auto first_letter = [](const std::string& value) {
        return static_cast<unsigned char>(value[0]) < 0x80 ? value.substr(0, 1) : std::string();
    };
    for (const PrivacyFinding& found : report.findings) {
        text += "  " + found.what;
        if (!found.value.empty())
            text += ": " + (shows_values ? found.value
                                         : first_letter(found.value) + "… (" + std::to_string(found.value.size()) +
                                               " characters)");
        text += "\n";
    }
    for (const std::string& unseen : report.unseen) text += "  " + unseen + "\n";
    return text;
}

}  // namespace kerf
