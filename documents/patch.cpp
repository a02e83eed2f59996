// SPDX-License-Identifier: Apache-2.0
#include "documents/patch.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "documents/patched_paths.h"
#include "documents/shapes/shapes.h"
#include "documents/yaml/read_map.h"
#include "text/codes.h"
#include "text/printable.h"

namespace kerf::documents {
namespace {

constexpr std::size_t max_parts = 16;          // of a path
constexpr const char* setting_name = "--set";  // shown as the name of its file
constexpr int max_changes = 1000;              // of a patch: each looks through what is there

bool is_id_of(const Node& item, std::string_view id) {
    const Node* found = item.find("id");
    return found && found->kind == Node::Kind::scalar && found->text == id;
}

/// A list whose items are addressed by their ids.
bool has_ids(const Node& node) {
    return node.kind == Node::Kind::list && !node.children.empty() &&
           std::all_of(node.children.begin(), node.children.end(), [](const Node& item) {
               const Node* id = item.find("id");
               return id && id->kind == Node::Kind::scalar && !id->text.empty();
           });
}

auto find_within(Node& node, std::string_view name) {
    return std::find_if(node.children.begin(), node.children.end(), [&](const Node& child) {
        return node.kind == Node::Kind::map ? child.key == name
                                            : node.kind == Node::Kind::list && is_id_of(child, name);
    });
}

std::vector<std::string> names_within(const Node& node) {
    std::vector<std::string> names;
    for (const Node& child : node.children) {
        const Node* id = node.kind == Node::Kind::map ? nullptr : child.find("id");
        if (node.kind == Node::Kind::map)
            names.push_back(child.key);
        else if (id)
            names.push_back(id->text);
    }
    return names;
}

/// The shape of what is under `name` in a map or list of this shape; null where none is known.
const ValueShape* shape_within(const ValueShape* shape, std::string_view name) {
    if (shape == nullptr) return nullptr;
    if (!shape->item.empty()) return &shape->item.front();
    const KeyShape* key = shape->shape != nullptr ? shape->shape->find(name) : nullptr;
    return key != nullptr ? &key->value : nullptr;
}

/// The keys that a map of this shape needs and `map` lacks.
std::vector<std::string> missing_keys(const Node& map, const ValueShape* shape) {
    std::vector<std::string> missing;
    if (shape == nullptr || shape->shape == nullptr) return missing;
    for (const KeyShape& key : shape->shape->keys)
        if (key.presence == Presence::required && map.find(key.name) == nullptr) missing.push_back(key.name + ":");
    return missing;
}

const ValueShape whole_procedure{.kind = ValueShape::Kind::map, .shape = &shapes::procedure};

/// As shown in a message.
std::string shown_value(const Node& node) {
    if (node.is_removal) return "`~`";
    if (node.kind == Node::Kind::scalar) return "`" + text::excerpt(node.text, 40) + "`";
    return node.kind == Node::Kind::map ? "a map" : "a list";
}

/// Applies one patch, or all `--set`, which are one patch together.
class Patcher {
public:
    Patcher(Document& document, Report& report) : document_(document), report_(report) {}

    void apply(Node& root, const Node& patch) { apply_all(root, &whole_procedure, patch); }

private:
    void apply_all(Node& target, const ValueShape* shape, const Node& patch) {
        for (const Node& change : patch.children) apply(target, shape, change, change.key);
    }

    /// `path` leads from `target`, which has this shape, to what `change` is for.
    void apply(Node& target, const ValueShape* shape, const Node& change, std::string_view path) {
        if (change.is_refused) return;
        if (++changes_ > max_changes) {
            if (changes_ == max_changes + 1)
                report_.error(text::Code::out_of_range, change.key_span,
                              "The patch is too long: got more than " + std::to_string(max_changes) +
                                  " changes. Write a procedure of its own.");
            return;
        }
        if (static_cast<std::size_t>(std::count(path.begin(), path.end(), '.')) >= max_parts) {
            report_.error(
                text::Code::nested_too_deep, change.key_span,
                "The path is too long: got more than " + std::to_string(max_parts) + " parts. Name something nearer.");
            return;
        }
        if (target.kind == Node::Kind::scalar || (target.kind == Node::Kind::list && !has_ids(target))) {
            refuse_way_in(target, change);
            return;
        }
        // Names may hold dots themselves: the longest that is there is meant.
        std::size_t end = path.size();
        auto found = find_within(target, path);
        while (found == target.children.end() && end != std::string_view::npos) {
            end = end == 0 ? std::string_view::npos : path.rfind('.', end - 1);
            if (end != std::string_view::npos) found = find_within(target, path.substr(0, end));
        }
        if (found == target.children.end() && path.substr(0, path.find('.')).find('[') != std::string_view::npos)
            refuse_index(target, change, path);
        else if (found == target.children.end())
            add(target, shape, change, path);
        else if (end == path.size())
            change_to(target, shape_within(shape, path), found, change, std::string(path));
        else
            within(std::string(path.substr(0, end)),
                   [&] { apply(*found, shape_within(shape, path.substr(0, end)), change, path.substr(end + 1)); });
    }

    /// Runs `rest` with `name` at the end of the path.
    template <class Rest>
    void within(std::string name, Rest&& rest) {
        path_.push_back(std::move(name));
        rest();
        path_.pop_back();
    }

    /// Records that the patch sets the value under `name`, or each of its parts. Returns false if it was set before.
    bool record(std::string name, const Node& change) {
        bool is_first = true;
        within(std::move(name), [&] { is_first = record_all(change); });
        return is_first;
    }

    bool record_all(const Node& change) {
        bool is_first = true;
        if (change.kind == Node::Kind::map) {
            for (const Node& child : change.children)
                if (!record(child.key, child)) is_first = false;
        } else if (has_ids(change)) {
            for (const Node& item : change.children)
                if (!record(item.find("id")->text, item)) is_first = false;
        } else {
            is_first = record_one(change);
        }
        return is_first;
    }

    bool record_one(const Node& change) {
        const TextSpan span = change.key.empty() ? change.span : change.key_span;
        const auto* before = paths_.record(path_, {.span = span, .value = shown_value(change), .path = {}});
        if (before == nullptr) return true;
        const std::string here = text::excerpt(path_text(path_)), there = text::excerpt(path_text(before->path));
        const std::string value = shown_value(change);
        const std::string both = here != there ? "`" + there + "` = " + before->value + " and `" + here + "` = " + value
                                 : before->value == value ? value + " twice"
                                                          : before->value + " and " + value;
        report_.error(
            text::Code::patched_twice, span,
            "The patch sets `" + here + "` twice: got " + both + ", expected one value. Remove one of the two.", {},
            report_.because(before->span, "it is set here first."));
        return false;
    }

    /// `steps[0].feed`: an id, not a number, names an item of a list.
    void refuse_index(const Node& target, const Node& change, std::string_view path) {
        const std::size_t open = path.find('['), close = std::min(path.find(']', open), path.size());
        const std::string list(path.substr(0, open));
        const std::string_view number = path.substr(open + 1, close - open - 1);
        const Node* items = target.find(list);
        const std::vector<std::string> ids =
            items != nullptr && has_ids(*items) ? names_within(*items) : std::vector<std::string>{};
        const bool is_number =
            !number.empty() && number.size() < 4 && number.find_first_not_of("0123456789") == std::string_view::npos;
        const std::size_t index = is_number ? std::stoul(std::string(number)) : ids.size();
        const std::string rest(path.substr(std::min(close + 1, path.size())));
        const std::string before = change.key.substr(0, change.key.size() - path.size());
        report_.error(text::Code::patch_nowhere, change.key_span,
                      "A path names the items of a list by their ids: got `" + text::excerpt(change.key, 40) + "`" +
                          (ids.empty() ? "." : ", expected " + listed(ids) + " behind `" + list + ".`.") +
                          (index < ids.size() ? "" : " Write an id, as in `steps.drill.feed`."),
                      index < ids.size() ? as_written(before + list + "." + ids[index] + rest, change) : "");
    }

    /// Returns a path as `change` has it: `accuracy.spacing=0.5 mm` for a setting, else with a colon.
    [[nodiscard]] std::string as_written(const std::string& path, const Node& change) const {
        const bool is_setting = document_.place(change.key_span).file == setting_name;
        return is_setting && change.kind == Node::Kind::scalar ? path + "=" + change.text : path + ":";
    }

    void refuse_way_in(const Node& target, const Node& change) {
        const std::string what = target.kind == Node::Kind::list
                                     ? "a list whose items have no ids. Replace it as a whole."
                                     : "a single value, with nothing inside. End the path there.";
        report_.error(text::Code::patch_nowhere, change.key_span,
                      "The path `" + text::excerpt(change.key) + "` leads into " + what, {},
                      report_.because(target.span, "the path leads into this."));
    }

    /// Something that `target` names has no such name.
    void refuse_name(const Node& target, const Node& change, std::string_view path, const std::string& name,
                     const std::vector<std::string>& missing) {
        const std::vector<std::string> known = names_within(target);
        std::string meant = closest(name, known, report_);
        if (known.size() == 1) meant = known.front();
        const bool is_key = change.key.data() <= path.data() && path.data() <= change.key.data() + change.key.size();
        const std::string before =
            is_key ? change.key.substr(0, static_cast<std::size_t>(path.data() - change.key.data())) : "";
        const std::string rest = path.size() > name.size() ? std::string(path.substr(name.size())) : "";
        const Node* id = change.key.empty() ? change.find("id") : nullptr;  // an item of a list
        report_.error(text::Code::patch_nowhere, id != nullptr ? id->span : change.key_span,
                      "Nothing is called `" + text::excerpt(name, 40) + "` here: expected " + listed(known, name) +
                          "." + (missing.empty() ? "" : " To add it, write " + listed_all(missing) + " as well.") +
                          or_choose(meant, missing.empty() ? "Write one of these." : ""),
                      meant.empty()   ? ""
                      : id != nullptr ? meant
                                      : before + meant + rest + ":",
                      report_.because(target.span, "the names are here."));
    }

    static std::string listed_all(const std::vector<std::string>& words) {
        std::string text;
        for (std::size_t i = 0; i < words.size(); ++i)
            text += (i == 0 ? "`" : i + 1 == words.size() ? " and `" : ", `") + words[i] + "`";
        return text;
    }

    void add(Node& target, const ValueShape* shape, const Node& change, std::string_view path) {
        // Names of parameters may hold dots.
        const bool has_free_names = shape != nullptr && shape->kind == ValueShape::Kind::parameters;
        const std::size_t dot = has_free_names ? std::string_view::npos : path.find('.');
        const std::string name(path.substr(0, dot));
        const bool is_named = shape != nullptr && shape->kind == ValueShape::Kind::named;
        if (target.kind == Node::Kind::list || (is_named && dot != std::string_view::npos)) {
            refuse_name(target, change, path, name, {});
            return;
        }
        if (change.is_removal) {
            const std::string meant = closest(path, names_within(target), report_);
            report_.error(text::Code::nothing_to_remove, change.key_span,
                          "There is no `" + text::excerpt(path, 40) + "` to remove." +
                              (meant.empty() ? " Remove this line." : " Write `" + meant + "`, or remove this line."));
            return;
        }
        if (const auto missing = missing_keys(change, shape_within(shape, name));
            is_named && change.kind == Node::Kind::map && !missing.empty() && !target.children.empty()) {
            refuse_name(target, change, path, name, missing);
            return;
        }
        Node added;
        if (dot == std::string_view::npos) {
            added = change;
        } else {
            added.kind = Node::Kind::map;
            added.span = change.span;
        }
        added.key = name;
        added.key_span = change.key_span;
        if (change.key_span.size == change.key.size()) {  // this part of the path
            added.key_span.begin += static_cast<std::size_t>(path.data() - change.key.data());
            added.key_span.size = name.size();
        }
        if (dot == std::string_view::npos && !record(name, added)) return;
        target.children.push_back(std::move(added));
        if (dot != std::string_view::npos)
            within(name,
                   [&] { apply(target.children.back(), shape_within(shape, name), change, path.substr(dot + 1)); });
    }

    /// `shape` and `name`: of what was found.
    void change_to(Node& parent, const ValueShape* shape, std::vector<Node>::iterator found, const Node& change,
                   std::string name) {
        if (change.kind == Node::Kind::map && (found->kind == Node::Kind::map || has_ids(*found))) {
            within(std::move(name), [&] { apply_all(*found, shape, change); });
        } else if (change.kind == Node::Kind::list && has_ids(change) && has_ids(*found)) {
            within(std::move(name), [&] { merge_items(*found, shape, change); });
        } else if (!record(std::move(name), change)) {
            return;  // which of the two is meant is open
        } else if (change.is_removal) {
            parent.children.erase(found);
        } else {
            document_.note_replaced(change.span, found->span);
            Node now = change;
            now.key = found->key;
            if (parent.kind == Node::Kind::list) now.key.clear();
            *found = std::move(now);
        }
    }

    void merge_items(Node& list, const ValueShape* shape, const Node& change) {
        for (const Node& item : change.children) {
            if (changes_ > max_changes) return;
            const std::string& id = item.find("id")->text;
            const auto same = find_within(list, id);
            const ValueShape* of_item = shape_within(shape, id);
            if (same != list.children.end())
                within(id, [&] {
                    for (const Node& change_of_item : item.children)
                        if (change_of_item.key != "id") apply(*same, of_item, change_of_item, change_of_item.key);
                });
            else if (const auto missing = missing_keys(item, of_item); !missing.empty())
                refuse_name(list, item, {}, id, missing);
            else if (record(id, item))
                list.children.push_back(item);
            ++changes_;
        }
    }

    Document& document_;
    Report& report_;
    int changes_ = 0;
    NodePath path_;  ///< from the root to the target
    PatchedPaths paths_;
};

/// Applies one `--set`.
void apply_setting(Document& document, const std::string& setting, Patcher& patcher, text::Diagnostics& diagnostics,
                   Report& report) {
    const std::size_t equals = setting.find('=');
    const std::string path = setting.substr(0, equals);
    std::optional<Document> text =
        parse_document(setting_name, path + ": " + setting.substr(std::min(equals, setting.size() - 1) + 1))
            .take(diagnostics);
    if (!text) return;
    const Node change = document.add_source(std::move(*text));
    if (!is_kind(change, Node::Kind::map, setting_name, report)) return;
    for (const Node& value : change.children)
        if (value.kind == Node::Kind::scalar && value.text.empty() && !value.is_removal && !value.is_quoted)
            report.error(
                text::Code::empty_value, value.key_span,
                "`--set " + text::excerpt(value.key) + "` has no value. Write one behind `=`, or `~` to remove it.");
        else if (value.key != path)
            report.error(text::Code::patch_nowhere, value.key_span,
                         "`--set` changes one value, got several. Write `--set` once for each.");
        else
            patcher.apply(document.root, change);
}

// ---- as YAML

bool is_plain(std::string_view text) {
    if (text.empty() || text == "~" || text == "null" || text.front() == ' ' || text.back() == ' ' ||
        text.back() == ':')
        return false;
    if (std::string_view("!&*?{}[],#|>@`\"'%:").find(text.front()) != std::string_view::npos) return false;
    if (text.front() == '-' && (text.size() < 2 || text[1] == ' ' || text[1] == '-')) return false;
    if (text.find(": ") != std::string_view::npos || text.find(" #") != std::string_view::npos) return false;
    return text::printable(text) == text;
}

/// What a terminal must not see is escaped, in the way of YAML.
std::string scalar(const std::string& text) {
    if (is_plain(text)) return text;
    std::string quoted = "\"";
    for (std::string_view rest = text; !rest.empty();) {
        const std::size_t end = std::min(rest.find_first_of("\n\t\r\"\\"), rest.size());
        quoted += text::printable(rest.substr(0, end));
        if (end < rest.size()) {
            const char c = rest[end];
            quoted += c == '\n' ? "\\n" : c == '\t' ? "\\t" : c == '\r' ? "\\r" : c == '"' ? "\\\"" : "\\\\";
        }
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return quoted + "\"";
}

class Emitter {
public:
    Emitter(const Document& document, bool is_annotated) : document_(document), is_annotated_(is_annotated) {}

    std::string text() && {
        children(document_.root, 0);
        return std::move(text_);
    }

private:
    /// `begun` is what the line holds already.
    void value(const Node& node, const std::string& begun, std::size_t indent) {
        const bool is_empty = node.children.empty();
        if (node.kind == Node::Kind::scalar) {
            line(begun + (node.text.empty() && !node.is_quoted ? "" : " " + scalar(node.text)), node);
        } else if (is_empty) {
            line(begun + (node.kind == Node::Kind::map ? " {}" : " []"), node);
        } else {
            text_ += begun + "\n";
            children(node, indent + 2);
        }
    }

    void children(const Node& node, std::size_t indent) {
        const std::string margin(indent, ' ');
        for (const Node& child : node.children) {
            if (indent == 0 && child.key == "variants") continue;  // they are chosen already
            if (node.kind == Node::Kind::map) {
                value(child, margin + scalar(child.key) + ":", indent);
            } else if (child.kind == Node::Kind::map && !child.children.empty()) {
                const std::size_t begin = text_.size();
                children(child, indent + 2);
                text_.replace(begin + indent, 1, "-");
            } else {
                value(child, margin + "-", indent);
            }
        }
    }

    void line(std::string shown, const Node& node) {
        if (is_annotated_) {
            const auto width = static_cast<std::size_t>(std::count_if(
                shown.begin(), shown.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; }));
            shown.append(width < 58 ? 58 - width : 1, ' ');
            const text::SourcePosition place = document_.place(node.span);
            shown += "  # " + text::printable(place.file) +
                     (place.file == setting_name ? "" : ":" + std::to_string(place.line));
        }
        text_ += shown + "\n";
    }

    const Document& document_;
    bool is_annotated_;
    std::string text_;
};

}  // namespace

void apply_patch(Document& document, Node& target, const Node& patch, Report& report) {
    Patcher(document, report).apply(target, patch);
}

void apply_patch_file(Document& document, const std::string& file, text::Diagnostics& diagnostics) {
    std::optional<std::string> text = read_text_file(file).take(diagnostics);
    if (!text) return;
    std::optional<Document> added = parse_document(file, *std::move(text)).take(diagnostics);
    if (!added) return;
    const Node patch = document.add_source(std::move(*added));
    Report report(document, diagnostics);
    if (!is_kind(patch, Node::Kind::map, "A patch", report)) return;
    if (const Node* kind = patch.find("kind")) {
        report.error(text::Code::patch_nowhere, kind->key_span,
                     "This file is a document of its own. A patch has paths and their values, as a variant's `patch:`.",
                     "rehearsals.expert.hand.push: 40 N");
        return;
    }
    apply_patch(document, document.root, patch, report);
}

void apply_settings(Document& document, const std::vector<std::string>& settings, text::Diagnostics& diagnostics) {
    Report report(document, diagnostics);
    Patcher patcher(document, report);
    for (const std::string& setting : settings) apply_setting(document, setting, patcher, diagnostics, report);
}

void override_setting(std::vector<std::string>& settings, const std::string& path, const std::string& value) {
    std::erase_if(settings, [&](const std::string& one) { return one.starts_with(path + "="); });
    settings.push_back(path + "=" + value);
}

std::string emitted(const Document& document, bool is_annotated) { return Emitter(document, is_annotated).text(); }

}  // namespace kerf::documents
