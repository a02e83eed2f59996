// SPDX-License-Identifier: Apache-2.0
// kerf-check-child: runs the tests of one plugin for `kerf check`, which never loads it. Results are JSON, one a line.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "conformance/acceptance_run.h"
#include "conformance/law_walk.h"
#include "conformance/schedule.h"
#include "conformance/subject.h"
#include "conformance/test.h"

extern "C" [[gnu::noinline]] int kerf_counted_resist(kerf::conformance::LawWalk* law);
extern "C" [[gnu::noinline]] int kerf_counted_resist(kerf::conformance::LawWalk* law) { return law->resist(); }

namespace {

using namespace kerf;
using Json = nlohmann::json;
using namespace kerf::conformance;

void print(const Json& line) {
    const std::string text = line.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
    std::fwrite(text.data(), 1, text.size(), stdout);
    std::fflush(stdout);
}

int list_tests() {
    for (const Test& test : all_tests()) print({{"test", test.id}, {"level", test.level}, {"sentence", test.sentence}});
    return 0;
}

/// Prints the law that was run and its wrenches, row by row.
int run_acceptance(const Json& request) {
    std::string error;
    AcceptanceFile file = standard_script();
    if (const std::string path = request.at("script"); !path.empty()) {
        auto read = read_acceptance(path, error);
        if (read) file = std::move(*read);
    }
    if (const std::string subject = request.at("subject"); !subject.empty()) file.subject = subject;
    if (error.empty()) error = run_script(request.at("plugin"), file);
    Json answer{{"error", error}, {"subject", file.subject}, {"wrenches", Json::array()}};
    for (const AcceptanceRow& row : file.rows)
        if (row.wrench) answer["wrenches"].push_back(*row.wrench);
    print(answer);
    return 0;
}

/// Calls a law along the short path, in this process: for callgrind, which counts between calls of one function.
int count_calls(const Json& request) {
    PluginLoad load = load_tried_plugin(request.at("plugin"));
    if (load.plugin == nullptr) return 2;
    const auto names = subjects_of(load.plugin->entry());
    const auto name = std::find_if(names.begin(), names.end(), [&](const SubjectName& one) {
        return one.scope == Scope::law && one.name == request.at("count");
    });
    if (name == names.end()) return 2;
    const Subject subject = subject_of(std::move(load.plugin), *name);
    LawWalk law(subject);
    if (!law.refusal().empty()) return 2;
    const auto path = short_path();
    law.begin(path.front());
    law.run_up();
    int calls = 0;
    for (std::size_t i = 0; i + 1 < path.size(); ++i, ++calls) {
        static_cast<void>(kerf_counted_resist(&law));
        static_cast<void>(law.commit(path[i + 1]));
    }
    print({{"calls", calls}});
    return 0;
}

/// What to do comes as one JSON argument: only `kerf` calls this program.
int run(const char* request_text) {
    const Json request = Json::parse(request_text);
    if (request.contains("count")) return count_calls(request);
    if (request.contains("script")) return run_acceptance(request);
    Selection selection{.level = request.at("level"), .only = request.at("only")};
    for (const Json& one : request.at("excluded")) selection.excluded.push_back({one.at(0), one.at(1)});
    run_tests(
        request.at("plugin"), selection,
        [](const std::string& plugin, const std::string& does_not) {
            print({{"plugin", plugin}, {"does_not", does_not}});
        },
        [](const TestResult& result) {
            print({{"id", result.id},
                   {"level", result.level},
                   {"subject", result.subject},
                   {"sentence", result.sentence},
                   {"status", static_cast<int>(result.status)},
                   {"text", result.text},
                   {"output", result.output},
                   {"seconds", result.seconds}});
        });
    print({{"end", true}});
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("kerf-check-child is called by `kerf check`. Write `kerf check PLUGIN`.\n", stderr);
        return 2;
    }
    try {
        return std::string(argv[1]) == "--list" ? list_tests() : run(argv[1]);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "kerf-check-child: %s\n", e.what());
        return 3;
    }
}
