// SPDX-License-Identifier: Apache-2.0
#include "app/privacy/text_search.h"

#include <pwd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

namespace kerf::app::privacy {
namespace {

constexpr std::size_t max_findings = 20;  // of one kind, in one file

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
}
bool is_word(char c) { return is_digit(c) || is_letter(c) || c == '_'; }

/// The user's and the machine's name. Short names are left out: they would be found everywhere.
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

class TextSearch {
public:
    /// @param where   is appended to each finding; not empty: the text was picked out of bytes, where names also occur
    /// by chance
    TextSearch(const std::string& text, PrivacyReport& report, std::string where = "")
        : text_(text), report_(report), where_(std::move(where)) {}

    void run() {
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
    /// A path below a folder of users or of the system, such as /home/jane/scan or C:\Users\jane.
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
        // In a hundred million bytes of noise a few look like a name.
        if (!where_.empty() && (!is_name(from, caret) || !is_name(caret + 1, end) || !is_bounded(from, end) ||
                                is_row_of_numbers(from, end)))
            return;
        if (caret - from >= 2 && end - caret > 2) add("a person's name as DICOM writes it", from, end);
    }
    /// Three letters or more, as `Doe` or `DOE`.
    [[nodiscard]] bool is_name(std::size_t from, std::size_t end) const {
        const auto is_capital = [&](std::size_t n) { return text_[n] >= 'A' && text_[n] <= 'Z'; };
        if (end - from < 3 || !is_capital(from)) return false;
        for (std::size_t n = from + 2; n < end; ++n)
            if (is_capital(n) != is_capital(from + 1)) return false;
        return true;
    }
    /// Whether a length, a tag, a space or a quotation mark bounds it, as they bound a value in a header or a text.
    [[nodiscard]] bool is_bounded(std::size_t from, std::size_t end) const {
        const auto bounds = [](char c) {
            return static_cast<unsigned char>(c) <= 0x20 ||
                   std::string_view("\"'<>=:;,^\\").find(c) != std::string_view::npos;
        };
        return (from == 0 || bounds(text_[from - 1])) && bounds(at(end));
    }
    /// Whether every second byte is the same, or a byte equals the fourth before and after it: then these are numbers
    /// of two or four bytes, such as corners of triangles.
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

/// Returns the letters that are written with two bytes each.
std::string out_of_utf16(const std::string& bytes) {
    std::string text;
    for (std::size_t at = 0; at + 1 < bytes.size();) {
        const bool is_pair = bytes[at] >= 0x20 && bytes[at] < 0x7f && bytes[at + 1] == '\0';
        text += is_pair ? bytes[at] : '\0';
        at += is_pair ? 2 : 1;
    }
    return text;
}

}  // namespace

void add_finding(PrivacyReport& report, const std::string& what, std::string value) {
    const auto same = [&](const PrivacyFinding& f) { return f.what == what && f.value == value; };
    const auto kind = [&](const PrivacyFinding& f) { return f.what == what; };
    auto& all = report.findings;
    if (std::any_of(all.begin(), all.end(), same) ||
        std::count_if(all.begin(), all.end(), kind) >= static_cast<std::ptrdiff_t>(max_findings))
        return;
    all.push_back({what, std::move(value)});
}

void search_text(const std::string& text, PrivacyReport& report, const std::string& where) {
    TextSearch(text, report, where).run();
}

void search_text_and_utf16(const std::string& bytes, PrivacyReport& report) {
    search_text(bytes, report);
    search_text(out_of_utf16(bytes), report);
}

}  // namespace kerf::app::privacy
