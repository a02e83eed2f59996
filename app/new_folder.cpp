// SPDX-License-Identifier: Apache-2.0
#include "app/new_folder.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "app/new_folder_files.h"
#include "text/printable.h"

namespace kerf::app {

namespace {

constexpr std::size_t max_name_length = 40;

bool is_name(const std::string& name) {
    const auto fits = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
    return !name.empty() && name.size() <= max_name_length && name[0] >= 'a' && name[0] <= 'z' &&
           std::all_of(name.begin(), name.end(), fits);
}

/// Returns the name nearest to a text: `My Tool` and `MyTool` are `my_tool`. `otherwise` if the text has no letters.
std::string name_from(const std::string& wanted, const std::string& otherwise) {
    std::string name;
    char before = '\0';
    for (const char c : wanted) {
        const bool is_capital = c >= 'A' && c <= 'Z', is_digit = c >= '0' && c <= '9';
        const bool is_kept = is_capital || is_digit || (c >= 'a' && c <= 'z');
        const bool is_new_word = !is_kept || (is_capital && before >= 'a' && before <= 'z');
        if (is_new_word && !name.empty() && name.back() != '_') name += '_';
        if (is_kept) name += is_capital ? static_cast<char>(c - 'A' + 'a') : c;
        before = c;
    }
    if (!name.empty() && (name[0] < 'a' || name == "null")) name.insert(0, "my_");
    name.resize(std::min(name.size(), max_name_length));
    while (name.ends_with('_')) name.pop_back();
    return name.empty() ? otherwise : name;
}

/// Returns why a plugin cannot have this name; empty if it can.
std::string taken_by(const std::string& name) {
    if (std::any_of(std::begin(taken_plugins), std::end(taken_plugins), [&](const char* one) { return name == one; }))
        return "a plugin of Kerf, whose library kerf_" + name + ".so the new one would replace when it is installed";
    if (name == "kerf") return "Kerf's own package, which the new one needs";
    return {};
}

/// `hand_saw` as `HandSaw`.
std::string camel_case(const std::string& name) {
    std::string type;
    bool is_first = true;
    for (const char c : name) {
        if (c != '_') type += is_first && c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
        is_first = c == '_';
    }
    return type;
}

/// Returns the name of a plugin's type. The SDK and the example have types, too, and macros are all in capitals.
std::string type_name(const std::string& name, const std::string& name_of_example) {
    std::string type = camel_case(name);
    if (name == name_of_example) return type;
    const auto is_taken = [&] {
        return std::none_of(type.begin(), type.end(), [](char c) { return c >= 'a' && c <= 'z'; }) ||
               std::any_of(std::begin(taken_words), std::end(taken_words),
                           [&](const char* one) { return type == one; });
    };
    while (is_taken()) type += "Tool";
    return type;
}

/// Removes the line that links to the next example.
std::string without_next(const std::string& text) {
    const std::size_t at = text.rfind("\nNext: ");
    return at == std::string::npos ? text : text.substr(0, at + 1);
}

using Replacements = std::vector<std::pair<std::string, std::string>>;

/// Replaces texts from left to right; of several at one position the first. A new text is not searched again.
std::string replaced(std::string_view text, const Replacements& replacements) {
    std::string result;
    while (!text.empty()) {
        const auto here = std::find_if(replacements.begin(), replacements.end(),
                                       [&](const auto& pair) { return text.starts_with(pair.first); });
        const bool is_found = here != replacements.end();
        result += is_found ? here->second : std::string(1, text.front());
        text.remove_prefix(is_found ? here->first.size() : 1);
    }
    return result;
}

/// An example that is a template.
struct Example {
    std::string folder;  ///< "02_round_burr"
    std::string name;    ///< of its files, and of its plugin or procedure
    std::span<const NewFile> files;
};

Example example_of(NewKind kind) {
    switch (kind) {
        case NewKind::tool:
            return {"02_round_burr", "round_burr", new_tool_files};
        case NewKind::strategy:
            return {"06_groove", "ball_groove", new_strategy_files};
        case NewKind::procedure:
            return {"08_procedure", "bicortical_hole", new_procedure_files};
    }
    return {};
}

}  // namespace

std::string write_new_folder(NewKind kind, const std::string& name, const std::string& wanted) {
    namespace fs = std::filesystem;
    const Example example = example_of(kind);
    const std::string command = kind == NewKind::procedure ? "kerf new procedure " : "kerf new plugin ";
    const auto owner_of = [&](const std::string& one) { return kind == NewKind::procedure ? "" : taken_by(one); };
    std::string meant = name_from(name, example.name);
    if (!owner_of(meant).empty()) meant.insert(0, "my_");
    if (!is_name(name))
        return "the name is `" + text::excerpt(name) +
               "`; it needs a-z, 0-9 and _, a letter first, 40 at most. Write `" + command + meant + "`.";
    if (name == "null") return "the name is `null`, which YAML reads as nothing. Write `" + command + meant + "`.";
    if (const std::string owner = owner_of(name); !owner.empty())
        return "the name `" + name + "` belongs to " + owner + ". Write `" + command + "my_" + name + "`.";
    const fs::path folder = wanted.empty() ? name : wanted;
    std::error_code error;
    if (fs::exists(fs::symlink_status(folder, error)))
        return "`" + folder.string() + "` exists already. Name another folder with `--out`.";
    if (!fs::create_directories(folder, error))
        return "`" + folder.string() + "` cannot be made: " + error.message() + ". Name another folder with `--out`.";
    for (const NewFile& file : example.files) {
        const fs::path path = folder / replaced(file.name, {{example.name, name}});
        const std::string text =
            replaced(without_next(file.text), {{example.folder, name},
                                               {example.name, name},
                                               {camel_case(example.name), type_name(name, example.name)},
                                               {"[The Kerf authors]", "[Your name]"}});
        fs::create_directories(path.parent_path(), error);
        std::ofstream out(path, std::ios::binary);
        out << text;
        out.close();
        if (!out) {
            fs::remove_all(folder, error);
            return "`" + path.string() + "` cannot be written. Name another folder with `--out`.";
        }
    }
    return {};
}

}  // namespace kerf::app
