// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/stability/atlas.h"

#include <cstddef>

#include "session/recorder.h"
#include "studies/drawing/svg.h"
#include "text/write_file.h"

namespace kerf::stability {

namespace {

std::string column(const std::string& text, std::size_t width) {
    return text + std::string(text.size() < width ? width - text.size() : 0, ' ') + "  ";
}

std::string line_of(const std::string& test, const std::string& scene, const std::string& method,
                    const std::string& device, const std::string& hand, const std::string& delay,
                    const std::string& outcome, const std::string& rest) {
    return column(test, 4) + column(scene, 38) + column(method, 10) + column(device, 16) + column(hand, 7) +
           column(delay, 5) + column(outcome, 4) + rest;
}

}  // namespace

std::string table_head() {
    return line_of("test", "scene", "method", "device", "hand", "delay", "", "measured | criterion | reason");
}

std::string table_line(const Finding& f) {
    return line_of(f.test, f.scene, to_text(f.method), f.device, f.hand, std::to_string(f.delay), to_text(f.outcome),
                   f.measured + " | " + f.criterion + (f.reason.empty() ? "" : " | " + f.reason));
}

std::string tally(std::span<const Finding> findings) {
    std::string text;
    for (const Method method : {Method::as_printed, Method::kerf}) {
        int count[3] = {};
        for (const Finding& f : findings)
            if (f.method == method) ++count[static_cast<int>(f.outcome)];
        text += column(to_text(method), 10) + std::to_string(count[0]) + " pass, " + std::to_string(count[1]) +
                " fail, " + std::to_string(count[2]) + " not applicable\n";
    }
    return text;
}

std::string atlas_csv(std::span<const Finding> findings) {
    std::string text = std::string("# ") + session::notice_line + ".\n" +
                       "test,scene,device,hand,delay_ticks,method,measured,criterion,outcome,reason\n";
    for (const Finding& f : findings) {
        for (const std::string& field :
             {f.test, f.scene, f.device, f.hand, std::to_string(f.delay), std::string(to_text(f.method)), f.measured,
              f.criterion, std::string(to_text(f.outcome))})
            text += drawing::csv_quoted(field) + ",";
        text += drawing::csv_quoted(f.reason) + "\n";
    }
    return text;
}

std::string write_atlas(const std::string& folder, std::span<const Finding> findings) {
    text::MadeFolders made;
    if (std::string error = made.make(folder); !error.empty()) return error;
    const std::string csv = text::write_file(folder + "/stability.csv", atlas_csv(findings));
    const std::string svg = text::write_file(folder + "/stability.svg", atlas_svg(findings));
    if (csv.empty()) made.keep();
    return csv.empty() || svg.empty() ? csv + svg : csv + "\n" + svg;
}

}  // namespace kerf::stability
