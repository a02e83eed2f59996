// SPDX-License-Identifier: Apache-2.0
#include "app/run_checks.h"

#include "core/haptics/device_record.h"
#include "core/procedure/document.h"
#include "core/procedure/read_map.h"

namespace kerf {

namespace {

/// A value of item `index` of the list `list`; the item if it has none, the whole document if there is no such item.
TextSpan span_in(const Document& document, const char* list, std::size_t index, const char* key) {
    const Node* items = document.root.find(list);
    if (items == nullptr || index >= items->children.size()) return {};
    const Node* value = items->children[index].find(key);
    return value != nullptr ? value->span : items->children[index].span;
}

void check_device(const Procedure& procedure, const Document& document, Report& report) {
    if (find_device(procedure.device.c_str()) != nullptr) return;
    int count = 0;
    const DeviceRecord* known = all_devices(count);
    std::vector<std::string> ids;
    for (int i = 0; i < count; ++i) ids.emplace_back(known[i].id);
    const Node* haptics = document.root.find("haptics");
    const Node* device = haptics != nullptr ? haptics->find("device") : nullptr;
    const std::string meant = closest(procedure.device, ids);
    report.error(Code::unknown_device, device != nullptr ? device->span : TextSpan{},
                 "There is no record of a device `" + procedure.device + "`; there is " + listed(ids) + "." + or_choose(meant), meant);
}

}  // namespace

void check_run(const Procedure& procedure, Diagnostics& diagnostics) {
    const Document document = read_again(procedure.file, procedure.text);
    Report report(document, diagnostics);
    check_device(procedure, document, report);
    const Step& first = procedure.steps.front();
    const auto keep_to_the_first = [&](std::size_t i, const char* key, const std::string& value, const std::string& wanted) {
        if (value != wanted)
            report.error(Code::one_tool_only, span_in(document, "steps", i, key),
                         std::string("Another ") + key + " than the first step's is not possible yet.", wanted,
                         report.because(span_in(document, "steps", 0, key), "the first step's is this."));
    };
    for (std::size_t i = 1; i < procedure.steps.size(); ++i) {
        keep_to_the_first(i, "instrument", procedure.steps[i].instrument, first.instrument);
        keep_to_the_first(i, "axis", procedure.steps[i].axis, first.axis);
    }
    for (std::size_t i = 0; i < procedure.rehearsals.size(); ++i) {
        const auto& path = procedure.rehearsals[i].path;
        if (path.size() < 2)
            report.error(Code::no_way, span_in(document, "rehearsals", i, "path"),
                         "The rehearsal has " + std::to_string(path.size()) +
                             " waypoint, must have at least 2: from where and to where. Add one.");
        else if (path.front().depth >= 0.0)
            report.error(Code::starts_in_bone, span_in(document, "rehearsals", i, "path"),
                         "The rehearsal starts inside the bone; its first waypoint must have a depth below 0 mm.",
                         "[{depth: -5 mm}, …]");
    }
}

void refuse_tool(const Procedure& procedure, const std::string& why, Diagnostics& diagnostics) {
    const Document document = read_again(procedure.file, procedure.text);
    const Node* instruments = document.root.find("instruments");
    const Node* node = instruments != nullptr ? instruments->find(procedure.steps.front().instrument) : nullptr;
    Report(document, diagnostics).error(Code::impossible_tool, node != nullptr ? node->span : TextSpan{}, why);
}

}  // namespace kerf
