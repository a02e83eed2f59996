// SPDX-License-Identifier: Apache-2.0
#include "app/new_folder.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <span>
#include <system_error>

#include "app/new_folder_files.h"

namespace kerf::app {

namespace {

constexpr std::size_t max_name_length = 40;

bool is_name(const std::string& name) {
    const auto fits = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
    return !name.empty() && name.size() <= max_name_length && name[0] >= 'a' && name[0] <= 'z' &&
           std::all_of(name.begin(), name.end(), fits);
}

/// `hand_saw` as `HandSaw`.
std::string type_name(const std::string& name) {
    std::string type;
    bool is_first = true;
    for (const char c : name) {
        if (c != '_') type += is_first && c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
        is_first = c == '_';
    }
    return type;
}

/// Removes the line that links to the next example.
std::string without_next(const std::string& text) {
    const std::size_t at = text.rfind("\nNext: ");
    return at == std::string::npos ? text : text.substr(0, at + 1);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
    return text;
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
    if (!is_name(name))
        return "the name is `" + name + "`; it needs a-z, 0-9 and _, a letter first, 40 at most. Write `kerf new " +
               (kind == NewKind::procedure ? "procedure " : "plugin ") + example.name + "`.";
    const fs::path folder = wanted.empty() ? name : wanted;
    std::error_code error;
    if (fs::exists(fs::symlink_status(folder, error)))
        return "`" + folder.string() + "` exists already. Name another folder with `--out`.";
    if (!fs::create_directories(folder, error))
        return "`" + folder.string() + "` cannot be made: " + error.message() + ". Name another folder with `--out`.";
    for (const NewFile& file : example.files) {
        const fs::path path = folder / replaced(file.name, example.name, name);
        std::string text = replaced(without_next(file.text), example.folder, name);
        text = replaced(replaced(text, example.name, name), type_name(example.name), type_name(name));
        text = replaced(text, "[The Kerf authors]", "[Your name]");
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
