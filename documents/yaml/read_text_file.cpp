// SPDX-License-Identifier: Apache-2.0
// Reading the text of a document, or why there is none.
#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

#include "documents/yaml/document.h"
#include "documents/yaml/largest_file.h"
#include "documents/yaml/read_map.h"
#include "text/codes.h"
#include "text/file_kind.h"
#include "text/printable.h"
#include "text/regular_file.h"

namespace kerf::documents {
namespace {

/// Returns whether a file of this kind is certainly no document. A JSON file may be one: JSON is YAML.
bool is_no_document(text::FileKind kind) {
    using enum text::FileKind;
    switch (kind) {
        case session:
        case scan:
        case surface:
        case page:
        case markdown:
        case picture:
        case pdf:
        case archive:
        case table:
        case shared_library:
        case database:
            return true;
        default:
            return false;
    }
}

std::string without_digits(std::string text) {
    std::erase_if(text, [](char c) { return c >= '0' && c <= '9'; });
    return text;
}

/// Returns "Write `procedures/hole.yaml`.", the file of the same folder with the nearest name. A name with
/// another number is no slip of the pen.
std::string advice_for_missing(const std::string& file) {
    constexpr std::size_t max_files = 200;
    const std::filesystem::path path = file, folder = path.parent_path();
    std::vector<std::string> names;
    std::error_code error;
    for (std::filesystem::directory_iterator at(folder.empty() ? "." : folder, error), end;
         !error && at != end && names.size() < max_files; at.increment(error))
        if (at->path().extension() == path.extension() &&
            without_digits(at->path().stem().string()) != without_digits(path.stem().string()))
            names.push_back(at->path().stem().string());
    std::sort(names.begin(), names.end());  // a folder lists them in any order
    const std::string meant = closest(path.stem().string(), names);
    return meant.empty() ? "Check its name and its folder."
                         : "Write `" + text::printable((folder / (meant + path.extension().string())).string()) + "`.";
}

}  // namespace

text::Result<std::string> read_text_file(const std::string& file) {
    const text::RecognisedFile found = text::recognise(file);
    if (is_no_document(found.kind))
        return text::Diagnostics{
            text::error_about(file, text::code_text(text::Code::other_file),
                              "The file is of another kind: " + text::other_kind_text(found, "a document in YAML"))};
    std::error_code failure;
    const auto refused = [&](const std::string& message) {
        return text::Diagnostics{text::error_about(file, text::code_text(text::Code::file_unreadable), message)};
    };
    if (!std::filesystem::exists(file, failure) && !failure)
        return refused("The file does not exist. " + advice_for_missing(file));
    if (std::filesystem::is_directory(file, failure))
        return refused("The path is " + found.name + ", expected a file. " +
                       (found.kind == text::FileKind::run_folder ? found.advice : "Name a YAML file in it."));
    if (const auto fault = text::fault_of_file(file)) {
        std::string problem = fault->problem;
        problem.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(problem.front())));
        return refused(problem + " " + fault->advice);
    }
    std::ifstream stream(file, std::ios::binary);
    if (!stream.is_open()) return refused("The file cannot be read. Name a YAML file, and check that you may read it.");
    const std::uintmax_t size = std::filesystem::file_size(file, failure);  // the largest number if it is unknown
    std::string text(static_cast<std::size_t>(std::min<std::uintmax_t>(size, largest_file)) + 1, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (stream.bad()) {
        return text::Diagnostics{text::error_about(file, text::code_text(text::Code::file_unreadable),
                                                   "Reading the file failed. Copy it to another disk.")};
    }
    text.resize(static_cast<std::size_t>(stream.gcount()));
    return text;  // one byte too many is refused where the text is parsed
}

}  // namespace kerf::documents
