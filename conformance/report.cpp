// SPDX-License-Identifier: Apache-2.0
#include "conformance/report.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "text/shell.h"

namespace kerf::conformance {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* notice = "For training and research; not for diagnosis, planning or deciding treatment";

/// The line that runs a test again.
std::string again(const TestResult& result, const std::string& path) {
    std::string pattern = "^";
    for (const char c : result.id) pattern += c == '.' ? std::string("\\.") : std::string(1, c);
    std::string line = "kerf check " + text::shell_path(path) + " --level " + std::to_string(result.level) +
                       " --only " + text::shell_quoted(pattern + "$");
    for (const std::string& option : result.options) line += " " + text::shell_quoted(option);
    return line;
}

std::string indented(const std::string& text, const std::string& by) {
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        out += by + text.substr(at, end - at) + "\n";
        at = end + 1;
    }
    return out;
}

std::string counted(std::size_t count, const std::string& what) { return std::to_string(count) + " " + what; }

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else if (c == '\n')
            out += "&#10;";
        else
            out += c;
    }
    return out;
}

std::string seconds_text(double seconds) {
    char text[40];
    std::snprintf(text, sizeof text, "%lld.%03d", static_cast<long long>(seconds),
                  static_cast<int>(1e3 * (seconds - static_cast<double>(static_cast<long long>(seconds)))));
    return text;  // a point, whatever the locale
}

}  // namespace

Tally tally(const PluginReport& report) noexcept {
    Tally count;
    for (const TestResult& result : report.results)
        ++(result.status == Status::passed   ? count.passed
           : result.status == Status::warned ? count.warned
           : result.status == Status::failed ? count.failed
                                             : count.skipped);
    return count;
}

bool is_conforming(const PluginReport& report) noexcept {
    const Tally count = tally(report);
    return report.error.empty() && count.run() > 0 && count.failed == 0;
}

std::string text_of(const TestResult& result, const std::string& path) {
    if (result.status != Status::failed && result.status != Status::warned) return {};
    std::string text = result.status == Status::failed ? "FAILED " : "warned ";
    text += result.id + (result.subject.empty() ? "" : "  of " + result.subject) + "\n";
    text += "        " + result.sentence + "\n";
    text += indented(result.text, "        ");
    if (!result.output.empty()) text += "        It printed:\n" + indented(result.output, "        | ");
    return text + "        Again: " + again(result, path) + "\n";
}

std::string summary_of(const PluginReport& report) {
    const Tally count = tally(report);
    std::string text = report.plugin.empty() ? report.path : report.plugin;
    text += ": " + std::to_string(count.run()) + " of " + counted(count.all(), "tests run");
    if (count.run() > 0 && count.failed + count.warned == 0) text += ", all passed";
    if (count.failed > 0) text += ", " + counted(count.failed, "failed");
    if (count.warned > 0) text += ", " + counted(count.warned, "with a warning");
    if (count.skipped > 0) {
        std::map<std::string, std::size_t> reasons;
        for (const TestResult& result : report.results)
            if (result.status == Status::skipped) ++reasons[result.text];
        text += ", " + counted(count.skipped, "skipped:");
        for (const auto& [reason, times] : reasons)
            text += (reasons.begin()->first == reason ? " " : "; ") + reason +
                    (times > 1 ? " (" + std::to_string(times) + ")" : "");
    }
    text += ".\n";
    if (!report.does_not.empty()) text += "  It does not " + report.does_not + ", as it declares.\n";
    for (const std::string& note : report.notes) text += "  " + note + "\n";
    return text;
}

std::string json_text(const std::vector<PluginReport>& reports) {
    Json all{{"notice", notice}, {"plugins", Json::array()}};
    for (const PluginReport& report : reports) {
        const Tally count = tally(report);
        Json one{{"path", report.path},         {"plugin", report.plugin},
                 {"does_not", report.does_not}, {"conforming", is_conforming(report)},
                 {"error", report.error},       {"passed", count.passed},
                 {"warned", count.warned},      {"failed", count.failed},
                 {"skipped", count.skipped},    {"notes", report.notes},
                 {"tests", Json::array()}};
        for (const TestResult& result : report.results)
            one["tests"].push_back({{"id", result.id},
                                    {"level", result.level},
                                    {"subject", result.subject},
                                    {"holds", result.sentence},
                                    {"status", to_text(result.status)},
                                    {"text", result.text},
                                    {"output", result.output},
                                    {"seconds", result.seconds},
                                    {"again", again(result, report.path)}});
        all["plugins"].push_back(std::move(one));
    }
    return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string junit_text(const std::vector<PluginReport>& reports) {
    std::string text =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- " + std::string(notice) + " -->\n<testsuites>\n";
    for (const PluginReport& report : reports) {
        const Tally count = tally(report);
        text += "  <testsuite name=\"" + escaped(report.plugin.empty() ? report.path : report.plugin) + "\" tests=\"" +
                std::to_string(count.all()) + "\" failures=\"" + std::to_string(count.failed) + "\" errors=\"" +
                (report.error.empty() ? "0" : "1") + "\" skipped=\"" + std::to_string(count.skipped) + "\">\n";
        for (const TestResult& result : report.results) {
            text += "    <testcase classname=\"" + escaped(result.subject.empty() ? "plugin" : result.subject) +
                    "\" name=\"" + escaped(result.id) + "\" time=\"" + seconds_text(result.seconds) + "\"";
            if (result.status == Status::failed)
                text += "><failure message=\"" + escaped(result.text) + "\">" + escaped(result.output) +
                        "</failure></testcase>\n";
            else if (result.status == Status::skipped)
                text += "><skipped message=\"" + escaped(result.text) + "\"/></testcase>\n";
            else if (!result.text.empty())
                text += "><system-out>" + escaped((result.status == Status::warned ? "warning: " : "") + result.text) +
                        "</system-out></testcase>\n";
            else
                text += "/>\n";
        }
        if (!report.error.empty())
            text += "    <testcase classname=\"plugin\" name=\"kit\"><error message=\"" + escaped(report.error) +
                    "\"/></testcase>\n";
        text += "  </testsuite>\n";
    }
    return text + "</testsuites>\n";
}

}  // namespace kerf::conformance
