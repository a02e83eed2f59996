// SPDX-License-Identifier: Apache-2.0
#include "documents/read_scoring.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "documents/known_metrics.h"
#include "documents/names.h"
#include "documents/shapes/shapes.h"
#include "text/codes.h"
#include "text/look_alike.h"
#include "text/printable.h"

namespace kerf::documents {

namespace {

constexpr std::size_t max_scored = 100;

/// Returns whether the step of a metric cannot be read well enough to know its metrics. That is reported there.
bool is_of_unread_step(const std::string& metric, const Procedure& procedure) {
    std::vector<std::string> ids;
    for (const Step& step : procedure.steps) {
        if (metric.starts_with(step.id + ".") && !step.id.empty())
            return find_id(procedure.instruments, step.instrument) == nullptr;
        if (step.id.empty() || contains(ids, step.id)) return true;
        ids.push_back(step.id);
    }
    return false;
}

const KnownMetric* find_metric(const Node& name, const std::vector<KnownMetric>& known,
                               const ProcedureContext& reading) {
    const auto found =
        std::find_if(known.begin(), known.end(), [&](const KnownMetric& one) { return one.id == name.text; });
    if (found != known.end()) return &*found;
    if (is_of_unread_step(name.text, reading.procedure)) return nullptr;
    std::vector<std::string> ids;
    for (const KnownMetric& one : known) ids.push_back(one.id);
    refuse_unknown({.code = text::Code::unknown_metric,
                    .span = name.span,
                    .subject = "The metric " + quoted_id(text::excerpt(name.text, 60)),
                    .word = text::straightened(name.text),
                    .known = ids,
                    .if_none = "the procedure has no steps."},
                   reading.report);
    return nullptr;
}

ScoredMetric read_scored(const Node& item, const std::vector<KnownMetric>& known, const ProcedureContext& reading) {
    Report& report = reading.report;
    ScoredMetric scored;
    scored.place = reading.document.place(item.span);
    MapReader map(item, shapes::scored_metric, "scoring", report);
    const int errors_before = report.errors();
    shapes::scored_metric.fill(map, scored);
    const Node* name = map.find("metric");
    const KnownMetric* metric = nullptr;
    if (name != nullptr && !read_text(*name, "scoring.metric", report).value_or("").empty())
        metric = find_metric(*name, known, reading);
    const auto value = [&](const char* key) -> std::optional<double> {
        const Node* node = map.find(key);
        if (node == nullptr || metric == nullptr) return {};
        return read_quantity(*node, name->text + "." + key, metric->need, report);
    };
    const auto full = value("full"), none = value("none");
    scored.target = value("target");
    map.finish();
    if (metric == nullptr || report.errors() > errors_before) return scored;
    scored.metric = metric->id;
    scored.step = metric->step;
    scored.unit = metric->need.unit;
    scored.full = full.value_or(0.0);
    scored.none = none.value_or(0.0);
    if (scored.full == scored.none)
        report.error(text::Code::contradiction, item.find("none")->span,
                     "The score of `" + scored.metric + "` has `full` equal to `none`: got " + item.find("none")->text +
                         " for both, so no value lies between all and nothing. Change one of the two.");
    else if (scored.target && (scored.full < 0.0 || scored.none < scored.full))
        report.error(text::Code::contradiction, item.find("none")->span,
                     "The score of `" + scored.metric +
                         "` has a `target`, so `full` and `none` are distances from it: got full " +
                         item.find("full")->text + " and none " + item.find("none")->text +
                         ", expected 0 or more, `none` the larger one. Change them.");
    return scored;
}

}  // namespace

std::vector<ScoredMetric> read_scoring(const Node& node, const ProcedureContext& reading) {
    Report& report = reading.report;
    std::vector<ScoredMetric> scoring;
    const std::vector<Node>& items = read_list(node, "scoring", report);
    if (items.size() > max_scored)
        report.error(text::Code::out_of_range, node.key_span,
                     "There are too many metrics: got " + std::to_string(items.size()) + ", expected at most " +
                         std::to_string(max_scored) + ". Remove some.");
    const std::vector<KnownMetric> known = metrics_of(reading.procedure, reading.catalog);
    for (const Node& item : items) {
        ScoredMetric scored = read_scored(item, known, reading);
        const auto is_same = [&](const ScoredMetric& one) { return one.metric == scored.metric; };
        if (!scored.metric.empty() && std::any_of(scoring.begin(), scoring.end(), is_same))
            report.error(text::Code::duplicate_id, item.find("metric")->span,
                         "The metric `" + scored.metric + "` is scored twice. Remove one of the two.");
        scoring.push_back(std::move(scored));
    }
    const auto is_weightless = [](const ScoredMetric& one) { return one.weight == 0.0; };
    if (!scoring.empty() && std::all_of(scoring.begin(), scoring.end(), is_weightless))
        report.error(text::Code::contradiction, node.key_span,
                     "The weights of `scoring` add up to 0: expected one above 0. Give one metric a weight.");
    return scoring;
}

}  // namespace kerf::documents
