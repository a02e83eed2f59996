// SPDX-License-Identifier: Apache-2.0
#include "app/findings.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "session/recorder.h"
#include "text/printable_lines.h"

namespace kerf::app {

namespace {

using Json = nlohmann::ordered_json;

const char* level_of(const text::Diagnostic& d) {
    return d.level == text::Diagnostic::Level::error ? "error" : "warning";
}

Json to_json(const text::SourcePosition& place) {
    return {
        {"file", text::shown(place.file)}, {"line", place.line}, {"column", place.column}, {"length", place.length}};
}

Json to_json(const text::Diagnostic& d) {
    Json json{{"level", level_of(d)}, {"code", d.code}};
    json.update(to_json(d.place));
    json["message"] = text::shown(d.message);
    json["write"] = text::shown(d.write);
    json["reason"] = nullptr;
    if (d.reason) {
        json["reason"] = to_json(d.reason->place);
        json["reason"]["message"] = text::shown(d.reason->message);
    }
    return json;
}

std::string json_of(const std::vector<Findings>& all) {
    Json files = Json::array();
    for (const Findings& one : all) {
        Json diagnostics = Json::array();
        for (const text::Diagnostic& d : one.diagnostics) diagnostics.push_back(to_json(d));
        files.push_back({{"file", one.file},
                         {"has_errors", text::has_error(one.diagnostics)},
                         {"diagnostics", std::move(diagnostics)}});
    }
    const Json document{{"schema", 1}, {"notice", session::notice_line}, {"files", std::move(files)}};
    return text::printable_json(document.dump(2, ' ', false, Json::error_handler_t::replace)) + "\n";
}

/// Escapes a text for a workflow command, which ends at a line end; its properties also end at `,` and `:`.
std::string escaped(const std::string& text, bool is_property) {
    std::string safe;
    for (const char c : text) switch (c) {
            case '%':
                safe += "%25";
                break;
            case '\r':
                safe += "%0D";
                break;
            case '\n':
                safe += "%0A";
                break;
            case ':':
                safe += is_property ? "%3A" : ":";
                break;
            case ',':
                safe += is_property ? "%2C" : ",";
                break;
            default:
                safe += c;
        }
    return safe;
}

std::string github_of(const text::Diagnostic& d) {
    std::string text = std::string("::") + level_of(d) + " file=" + escaped(text::shown(d.place.file), true);
    if (d.place.line > 0) text += ",line=" + std::to_string(d.place.line) + ",col=" + std::to_string(d.place.column);
    text += ",title=" + d.code + "::" + escaped(text::shown(d.message), false);
    if (!d.write.empty()) text += escaped(" Write `" + text::shown(d.write) + "`.", false);
    if (d.reason)
        text += escaped("\nbecause of " + text::shown(to_text(d.reason->place) + ": " + d.reason->message), false);
    return text + "\n";
}

}  // namespace

std::string findings_text(const std::vector<Findings>& all, const std::string& format) {
    if (format == "json") return json_of(all);
    std::string text;
    for (const Findings& one : all) {
        if (format == "github") {
            for (const text::Diagnostic& d : one.diagnostics) text += github_of(d);
            continue;
        }
        text += to_text(one.diagnostics);
        if (!text::has_error(one.diagnostics)) text += text::shown(one.file) + ": no errors\n";
    }
    return text;
}

}  // namespace kerf::app
