// SPDX-License-Identifier: Apache-2.0
// Scores of the forty hands of studies/hands against the order that a reader gave them by the clinical sources.
//
//     bench_hands [FOLDER]   prints verdict, score and reason of each, and the rank correlations; writes hands.svg
//
// About ten minutes. For training and research; not for diagnosis, planning or deciding treatment.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/make_bone.h"
#include "bench/into_folder.h"
#include "run/run_procedure.h"
#include "studies/drawing/svg.h"
#include "studies/rank_correlation.h"
#include "tests/support/drill_rig.h"
#include "text/write_file.h"

namespace {

using namespace kerf;
using test::plugins;

const std::string hands_folder = KERF_SOURCE_DIR "/studies/hands/";

struct Judged {
    int tier;               ///< 1: the best, by the reader
    std::string operation;  ///< stem of the procedure's file
    std::string hand;       ///< id of a rehearsal
    session::RunSummary summary{};
};

/// Reads order.csv: "tier,operation,hand".
std::vector<Judged> hands_in_order() {
    std::ifstream file(hands_folder + "order.csv");
    std::vector<Judged> hands;
    std::string line;
    if (!std::getline(file, line)) throw std::runtime_error("cannot read " + hands_folder + "order.csv");
    while (std::getline(file, line) && !line.empty()) {
        std::istringstream fields(line);
        std::string tier, operation, hand;
        std::getline(fields, tier, ',');
        std::getline(fields, operation, ',');
        std::getline(fields, hand);
        hands.push_back({std::stoi(tier), operation, hand});
    }
    return hands;
}

run::Scene scene_of(const std::string& operation) {
    const std::string file = KERF_SOURCE_DIR "/procedures/" + operation + ".yaml";
    // The bones for which the hands were put in order. In that jaw `midline` lies on the side of the tongue, to which a
    // hand leans; in the shipped jaw it lies along the arch.
    run::DocumentRequest request{
        .procedure = file,
        .anatomy = operation == "dental-implant"  ? hands_folder + "jaw.yaml"
                   : operation == "pedicle-screw" ? KERF_SOURCE_DIR "/procedures/anatomy/vertebra-phantom.yaml"
                   : operation == "amputation"    ? KERF_SOURCE_DIR "/procedures/anatomy/knee-phantom.yaml"
                                                  : ""};
    request.changes.patches = {hands_folder + operation + ".yaml"};
    text::Diagnostics diagnostics;
    auto documents = run::check_documents(request, plugins()).take(diagnostics);
    auto scene = documents ? app::make_bone(std::move(*documents), file).take(diagnostics) : std::nullopt;
    if (!scene) throw std::runtime_error(to_text(diagnostics));
    return std::move(*scene);
}

constexpr int first_between = 2, last_between = 23;  // tiers without the best and those that do nothing

double correlation(const std::vector<Judged>& hands, const std::string& operation = {}, bool is_between = false) {
    std::vector<double> order, scores;
    for (const Judged& one : hands) {
        if (!operation.empty() && one.operation != operation) continue;
        if (is_between && (one.tier < first_between || one.tier > last_between)) continue;
        order.push_back(-one.tier);
        scores.push_back(one.summary.score);
    }
    return rank_correlation(order, scores);
}

std::string reason_of(const session::RunSummary& summary) {
    return summary.reasons.empty() ? "" : summary.reasons.front();
}

std::string picture_of(const std::vector<Judged>& hands) {
    constexpr double top = 70, row = 21, name = 10, bar = 350, per_point = 2.4, words = bar + 100 * per_point + 120,
                     width = 1360;
    const double height = top + row * static_cast<double>(hands.size()) + 50;
    constexpr std::array colours{std::pair("pass", "#2f7d5b"), std::pair("minor", "#b08900"),
                                 std::pair("serious", "#c2571a"), std::pair("incomplete", "#7a6a9c"),
                                 std::pair("critical", "#a31621")};
    const auto px = &drawing::px;
    std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + px(width) + " " + px(height) +
                      "\" font-family=\"sans-serif\" font-size=\"13\" fill=\"#222\"><rect width=\"100%\" "
                      "height=\"100%\" fill=\"#fff\"/>";
    svg += drawing::text_at(name, 24, "Forty hands in the order of the clinical sources, with their scores",
                            "font-size=\"17\" font-weight=\"600\"");
    svg += drawing::text_at(
        name, 46,
        "rank correlation " + drawing::figure(correlation(hands), 2) + "; the tier is the reader's, 1 the best");
    double x = width - 10;
    for (auto band = colours.rbegin(); band != colours.rend(); ++band) {
        x -= 20 + 8 * static_cast<double>(std::string_view(band->first).size());
        svg += "<rect x=\"" + px(x) + "\" y=\"36\" width=\"11\" height=\"11\" fill=\"" + band->second + "\"/>" +
               drawing::text_at(x + 15, 46, band->first);
    }
    double y = top;
    for (const Judged& one : hands) {
        const session::RunSummary& run = one.summary;
        const auto colour = std::find_if(colours.begin(), colours.end(),
                                         [&](const auto& band) { return run.score_band == band.first; });
        if (static_cast<int>((y - top) / row) % 2 == 0)
            svg += "<rect x=\"0\" y=\"" + px(y) + "\" width=\"" + px(width) + "\" height=\"" + px(row) +
                   "\" fill=\"#f4f4f2\"/>";
        svg += drawing::text_at(name, y + 15, std::to_string(one.tier));
        svg += drawing::text_at(name + 30, y + 15, one.operation, "fill=\"#666\"");
        svg += drawing::text_at(name + 170, y + 15, one.hand);
        svg += "<rect x=\"" + px(bar) + "\" y=\"" + px(y + 4) + "\" width=\"" +
               px(std::max(1.0, per_point * run.score)) + "\" height=\"13\" fill=\"" +
               (colour == colours.end() ? "#888" : colour->second) + "\"/>";
        svg += drawing::text_at(bar + per_point * 100 + 10, y + 15,
                                drawing::figure(std::round(run.score)) + "  " + to_text(run.verdict));
        std::string reason = reason_of(run);
        constexpr std::size_t longest = 88;
        if (reason.size() > longest) reason = reason.substr(0, reason.rfind(' ', longest)) + " …";
        std::erase(reason, '`');
        svg += drawing::text_at(words, y + 15, reason, "font-size=\"12\" fill=\"#444\"");
        y += row;
    }
    svg +=
        drawing::text_at(name, y + 28, "For training and research; not for diagnosis, planning or deciding treatment.",
                         "fill=\"#666\" font-size=\"12\"");
    return svg + "</svg>\n";
}

int run(const std::string& folder) {
    std::printf("For training and research; not for diagnosis, planning or deciding treatment.\n");
    std::vector<Judged> hands = hands_in_order();
    std::map<std::string, run::Scene> scenes;
    std::size_t done = 0;
    for (Judged& one : hands) {
        auto scene = scenes.find(one.operation);
        if (scene == scenes.end()) scene = scenes.emplace(one.operation, scene_of(one.operation)).first;
        run::RunRequest request;
        request.rehearsal = one.hand;
        const run::RunOutcome outcome = run::run_procedure(scene->second, plugins(), request);
        if (!outcome.error.empty()) throw std::runtime_error(one.hand + ": " + outcome.error);
        one.summary = outcome.summary;
        std::printf("%2zu/%zu  tier %2d  %-20s %-26s %5.1f  %-10s %s\n", ++done, hands.size(), one.tier,
                    one.operation.c_str(), one.hand.c_str(), one.summary.score, to_text(one.summary.verdict),
                    reason_of(one.summary).c_str());
        std::fflush(stdout);
    }
    for (const auto& [operation, scene] : scenes)
        std::printf("rank correlation, %-20s %.3f\n", operation.c_str(), correlation(hands, operation));
    std::printf("rank correlation, %-20s %.3f\n", "all", correlation(hands));
    std::printf("rank correlation, %-20s %.3f\n", "tiers 2 to 23", correlation(hands, {}, true));
    const std::string error = folder.empty() ? "" : text::write_file(folder + "/hands.svg", picture_of(hands));
    if (!error.empty()) throw std::runtime_error(error);
    return 0;
}

}  // namespace

int main(int argc, char** argv) { return kerf::run_into_folder(argc, argv, ::run); }
