// SPDX-License-Identifier: Apache-2.0
#include "app/attempts.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <system_error>
#include <tuple>
#include <utility>

#include "app/standard_streams.h"
#include "text/printable.h"
#include "text/regular_file.h"

namespace kerf::app {

namespace {

namespace fs = std::filesystem;

constexpr int max_number = 999'999;

fs::path folder_of(const std::string& folder, const std::string& learner) {
    return fs::path(folder) / (learner.empty() ? "no-code" : learner);
}

/// Returns the number of an attempt's folder; 0 for another name.
int number_of(const std::string& name) {
    int number = 0;
    const auto [end, status] = std::from_chars(name.data(), name.data() + name.size(), number);
    const bool is_number = status == std::errc{} && end == name.data() + name.size() && name.size() >= 3;
    return is_number && number > 0 && number <= max_number ? number : 0;
}

/// Returns the names in a folder, sorted; none if it cannot be read.
std::vector<std::string> names_in(const fs::path& folder) {
    std::vector<std::string> names;
    std::error_code error;
    for (auto entry = fs::directory_iterator(folder, error); !error && entry != fs::directory_iterator();
         entry.increment(error))
        names.push_back(entry->path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

/// Returns a file of at most 16 MiB; empty if it cannot be read, or is longer.
std::string contents_of(const fs::path& file) {
    constexpr std::uintmax_t max_size = 16u << 20;
    std::error_code error;
    const std::uintmax_t size = fs::file_size(file, error);
    if (error || size > max_size) return {};
    std::ifstream in = text::open_regular_file(file.string());
    return {std::istreambuf_iterator<char>(in), {}};
}

std::optional<double> number_in(const nlohmann::json& summary, const char* key) {
    const auto found = summary.find(key);
    return found != summary.end() && found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
}

std::string text_in(const nlohmann::json& summary, const char* key) {
    const auto found = summary.find(key);
    return found != summary.end() && found->is_string() ? text::excerpt(found->get<std::string>(), 40) : "";
}

window::StartAttempt read_attempt(const std::string& procedure, int number, const fs::path& folder) {
    window::StartAttempt attempt{.procedure = procedure, .number = number, .folder = folder.string()};
    std::error_code ignored;
    attempt.has_session = fs::is_regular_file(folder / "session.db", ignored);
    attempt.has_report = fs::is_regular_file(folder / "report.html", ignored);
    const auto summary = nlohmann::json::parse(contents_of(folder / "summary.json"), nullptr, false);
    if (summary.is_object()) {
        attempt.verdict = text_in(summary, "verdict");
        attempt.score = number_in(summary, "score");
        attempt.duration = number_in(summary, "duration_s");
        attempt.is_demonstration = text_in(summary, "hand") == "simulated";
    }
    if (attempt.verdict.empty()) attempt.verdict = "no result";
    return attempt;
}

}  // namespace

std::string make_attempt_folder(const std::string& folder, const std::string& learner, const std::string& procedure,
                                std::string& error) {
    const fs::path above = folder_of(folder, learner) / procedure;
    std::error_code fault;
    fs::create_directories(above, fault);
    int number = 0;
    for (const std::string& name : names_in(above)) number = std::max(number, number_of(name));
    while (!fault && ++number <= max_number) {
        const fs::path attempt = above / formatted("%03d", number);
        if (fs::create_directory(attempt, fault)) return attempt.string();  // false: another process was faster
        if (fault == std::errc::file_exists) fault.clear();                 // a file has this name
    }
    error = "the folder of the attempt cannot be made in " + above.string() + ": " +
            (fault ? fault.message() : "it is full") + ". Choose another folder with `--attempts`.";
    return {};
}

void remove_empty_attempt(const std::string& attempt) {
    std::error_code ignored;
    if (fs::is_empty(attempt, ignored) && !ignored) fs::remove(attempt, ignored);
}

std::vector<window::StartAttempt> read_attempts(const std::string& folder, const std::string& learner) {
    std::vector<window::StartAttempt> attempts;
    const fs::path above = folder_of(folder, learner);
    for (const std::string& procedure : names_in(above))
        for (const std::string& name : names_in(above / procedure))
            if (const int number = number_of(name); number > 0)
                attempts.push_back(read_attempt(text::printable(procedure), number, above / procedure / name));
    std::stable_sort(attempts.begin(), attempts.end(), [](const auto& a, const auto& b) {
        return std::tuple(a.procedure, -a.number) < std::tuple(b.procedure, -b.number);
    });
    return attempts;
}

}  // namespace kerf::app
