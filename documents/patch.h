// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "documents/yaml/document.h"

/// Documents that differ from another in a few values: variants of a procedure, and `--patch` and `--set` on
/// the command line.
namespace kerf::documents {

/// Changes the tree at `target` as the map `patch` says; what is wrong is reported at the patch's own position.
///
/// A key is a path: keys of maps, and ids of the items of lists, with dots between them. A value replaces the
/// one that is there, but maps are merged key by key, lists whose items have ids item by item, and `~` removes. Keys
/// that a map lacks are added, items too. Error: the patch sets a value twice, even to the same.   [main]
void apply_patch(Document& document, Node& target, const Node& patch, Report& report);

/// Applies the patch of a file: a map as in a variant's `patch:`. Messages name the file.
/// Error: the file cannot be read, or is a document of its own.   [main]
void apply_patch_file(Document& document, const std::string& file, text::Diagnostics& diagnostics);

/// Applies settings `path=value`, each value in YAML, as one patch. Their positions are shown as those of a text named
/// `--set`.   [main]
void apply_settings(Document& document, const std::vector<std::string>& settings, text::Diagnostics& diagnostics);

/// Adds `path=value` to the settings of a command, and removes those of the same path: for a value that a program
/// varies itself.   [main]
void override_setting(std::vector<std::string>& settings, const std::string& path, const std::string& value);

/// The tree as YAML that reads back to the same tree; with `is_annotated` every value says where it comes from. [main]
[[nodiscard]] std::string emitted(const Document& document, bool is_annotated);

}  // namespace kerf::documents
