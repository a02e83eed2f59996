// SPDX-License-Identifier: Apache-2.0
#include "documents/refuse_extends.h"

#include <algorithm>
#include <string>

#include "documents/names.h"
#include "text/codes.h"
#include "text/printable.h"

namespace kerf::documents {

bool refuse_extends(Document& document, const Shape& whole, text::Diagnostics& found) {
    static const std::vector<std::string> keys{"extends", "include", "import",  "inherits",
                                               "inherit", "base",    "based_on"};
    if (document.root.kind != Node::Kind::map) return false;
    Report report(document, found);
    const auto is_other = [&](const Node& child) {
        return contains(keys, child.key) && whole.find(child.key) == nullptr && child.kind == Node::Kind::scalar;
    };
    const auto other = std::find_if(document.root.children.begin(), document.root.children.end(), is_other);
    if (other == document.root.children.end()) return false;
    const bool has_variants = whole.find("variants") != nullptr;
    report.error(text::Code::unknown_key, other->key_span,
                 "The key `" + other->key + "` is unknown: a document is complete, and builds on no other file. " +
                     (has_variants ? "Write what differs as a variant under `variants:` of `" +
                                         text::excerpt(other->text, 40) + "`, or as a file for `--patch`."
                                   : "Copy `" + text::excerpt(other->text, 40) + "`, and change the copy."));
    document.root.children.erase(other);
    return std::any_of(whole.keys.begin(), whole.keys.end(), [&](const KeyShape& key) {
        return key.presence == Presence::required && document.root.find(key.name) == nullptr;
    });
}

}  // namespace kerf::documents
