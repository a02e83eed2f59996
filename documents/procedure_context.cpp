// SPDX-License-Identifier: Apache-2.0
#include "documents/procedure_context.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "documents/consequences.h"
#include "documents/names.h"
#include "documents/yaml/read_map.h"
#include "text/codes.h"
#include "text/look_alike.h"

namespace kerf::documents {
namespace {

/// Whether a list of the document holds this text, even if it was refused there.
bool is_written(const Node* list, const std::string& text) {
    return list != nullptr && std::any_of(list->children.begin(), list->children.end(),
                                          [&](const Node& item) { return item.text == text || item.key == text; });
}

}  // namespace

std::string ProcedureContext::landmark(const Node& name, const std::string& called) const {
    const std::string id = read_id(name, called, report).value_or("");
    if (!id.empty() && !contains(procedure.needs_landmarks, id))
        refuse_undeclared(text::Code::undeclared_landmark, name, "landmark");
    return id;
}

void ProcedureContext::refuse_undeclared(text::Code code, const Node& name, const std::string& what) const {
    const std::vector<std::string>& declared = what == "zone" ? procedure.needs_zones : procedure.needs_landmarks;
    const std::string list = what + "s", meant = closest(text::straightened(name.text), declared, report);
    const Node* needs = document.root.find("needs");
    const Node* place = needs ? needs->find(list) : nullptr;
    const bool is_list = place == nullptr || place->kind == Node::Kind::list;
    if (needs == nullptr || needs->kind != Node::Kind::map || !is_list || is_written(place, name.text)) return;
    report.error(
        code, name.span,
        undeclared_text(what, name.text) + " expected one of `needs." + list + "`" +
            (declared.empty() ? std::string() : ", " + listed(declared, name.text)) + "." +
            or_choose(meant, "Add it there."),
        meant,
        place ? std::optional(report.because(place->key_span, "the procedure lists its needs here.")) : std::nullopt);
}

void ProcedureContext::refuse_step(const Node& name) const {
    std::vector<std::string> known;
    for (const Step& step : procedure.steps)
        if (!step.id.empty() && !contains(known, step.id)) known.push_back(step.id);
    const Node* steps = document.root.find("steps");
    for (const Node& step : steps != nullptr ? steps->children : std::vector<Node>{})
        if (const Node* id = step.find("id"); id != nullptr && id->text == name.text) return;  // refused there
    const bool has_nameless = std::any_of(procedure.steps.begin(), procedure.steps.end(),
                                          [](const Step& step) { return step.id.empty(); });  // reported there
    if (known.empty() || (has_nameless && !is_near_any(text::straightened(name.text), known))) return;
    refuse_unknown({.code = text::Code::unknown_step,
                    .span = name.span,
                    .subject = "The step " + quoted_id(name.text),
                    .word = text::straightened(name.text),
                    .known = known},
                   report);
}

}  // namespace kerf::documents
