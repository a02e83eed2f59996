// SPDX-License-Identifier: Apache-2.0
#include "conformance/schedule.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>
#include <utility>

#include "conformance/sandbox.h"
#include "conformance/subject.h"
#include "core/plugin/loader.h"
#include "core/plugin/plain_text.h"

namespace kerf::conformance {

namespace {

using Json = nlohmann::json;

/// One test of one subject, on its way to a result.
struct Task {
    const Test* test = nullptr;
    SubjectName subject;
    std::optional<TestResult> result{};
    std::unique_ptr<Sandbox> child{};
};

TestResult result_of(const Task& task, Status status, const std::string& text) {
    return {task.test->id, task.test->level, task.subject.name, task.test->sentence, status, text, "", 0.0};
}

bool matches(const std::string& id, const std::string& pattern) {
    return std::regex_search(id, std::regex(pattern, std::regex::ECMAScript));
}

/// What a test's child returns: its status, and its text.
std::string examined(const std::string& path, const Task& task) {
    std::optional<Subject> subject;
    if (task.test->scope != Scope::file) {
        PluginLoad load = load_tried_plugin(path);
        if (load.plugin == nullptr) return Json{{"status", 3}, {"text", load.refusal}}.dump();
        subject = subject_of(std::move(load.plugin), task.subject);
    }
    Examination exam(path, subject ? &*subject : nullptr);
    const std::uint32_t left_out =
        subject && subject->force != nullptr ? subject->force->force->does_not & task.test->except : 0;
    if (left_out != 0)
        exam.skip("the law does not " + words_of_does_not(left_out).front() + ", as it declares");
    else
        task.test->body(exam);
    return Json{{"status", static_cast<int>(exam.status())}, {"text", exam.text()}}.dump(
        -1, ' ', false, Json::error_handler_t::replace);
}

TestResult result_of(Task& task) {
    Ended ended = task.child->ended();
    task.child.reset();
    TestResult result = result_of(task, Status::failed, ended.text);
    result.seconds = ended.seconds;
    result.output = std::move(ended.output);
    if (ended.how == Ended::How::returned) {
        const Json answer = Json::parse(ended.text, nullptr, false);
        result.status = static_cast<Status>(answer.value("status", 2));
        result.text = answer.value("text", "");
    }
    return result;
}

/// What a plugin's laws leave out on purpose: "resist sideways, rest on bone (burring)"; empty: nothing.
std::string left_out_by(const kerf_entry& entry) {
    std::string text;
    for (std::uint32_t i = 0; i < entry.component_count; ++i) {
        const kerf_component& c = entry.components[i];
        if (c.kind != KERF_KIND_FORCE || c.force->does_not == 0) continue;
        std::string words;
        for (const std::string& word : words_of_does_not(c.force->does_not))
            words += (words.empty() ? "" : ", ") + word;
        text += (text.empty() ? "" : ", ") + words + " (" + c.id + ")";
    }
    return text;
}

/// What is loaded: its id and version, and what its laws leave out.
struct Loaded {
    std::string plugin, does_not;
};

/// The file's tests run first; what the plugin contains is read then.
std::vector<SubjectName> subjects_in(const std::string& path, Loaded& loaded, std::string& why_not) {
    const Ended ended = run_in_child([&] {
        const PluginLoad load = load_tried_plugin(path);
        if (load.plugin == nullptr) return Json{{"refusal", load.refusal}}.dump();
        const kerf_entry& entry = load.plugin->entry();
        Json answer{{"plugin", std::string(entry.plugin_id) + " " + plain(entry.plugin_version)},
                    {"does_not", left_out_by(entry)},
                    {"subjects", Json::array()}};
        for (const SubjectName& name : subjects_of(entry))
            answer["subjects"].push_back(
                {static_cast<int>(name.scope), name.name, name.tool, name.force, name.strategy, name.device});
        return answer.dump(-1, ' ', false, Json::error_handler_t::replace);
    });
    const Json answer = ended.how == Ended::How::returned ? Json::parse(ended.text, nullptr, false) : Json();
    if (!answer.is_object() || !answer.contains("subjects")) {
        why_not = "the plugin cannot be loaded";
        return {};
    }
    loaded = {answer["plugin"], answer["does_not"]};
    std::vector<SubjectName> names;
    for (const Json& one : answer["subjects"])
        names.push_back({static_cast<Scope>(one[0].get<int>()), one[1], one[2], one[3], one[4], one[5]});
    return names;
}

/// Runs tasks, each once the one that it needs has ended, and passes on results in order.
class Schedule {
public:
    Schedule(const std::string& path, std::function<void(const TestResult&)> on_result)
        : path_(path), on_result_(std::move(on_result)) {}

    void run(std::vector<Task> tasks) {
        const std::size_t before = tasks_.size();
        for (Task& task : tasks) tasks_.push_back(std::move(task));
        std::size_t passed_on = before;
        while (passed_on < tasks_.size()) {
            start_what_can();
            wait();
            for (; passed_on < tasks_.size() && tasks_[passed_on].result; ++passed_on)
                on_result_(*tasks_[passed_on].result);
        }
    }
    /// Whether the plugin as a whole failed this test.
    [[nodiscard]] bool has_failed(const std::string& id) const {
        const Task* const task = needed(id, "");
        return task != nullptr && task->result && task->result->status == Status::failed;
    }

private:
    [[nodiscard]] const Task* needed(const std::string& id, const std::string& subject) const {
        const Task* of_plugin = nullptr;
        for (const Task& task : tasks_) {
            if (task.test->id != id) continue;
            if (task.subject.name == subject) return &task;
            if (task.subject.name.empty()) of_plugin = &task;
        }
        return of_plugin;
    }
    void start_what_can() {
        const auto is_busy = [](const Task& task) { return task.child != nullptr; };
        // A device may be open once only, so tests of devices take turns.
        const auto is_of_device = [](const Task& task) { return task.test->scope == Scope::device; };
        const auto is_busy_with_device = [&](const Task& task) { return is_busy(task) && is_of_device(task); };
        const long processors = std::clamp(sysconf(_SC_NPROCESSORS_ONLN), 1l, 4l);
        auto free = processors - std::count_if(tasks_.begin(), tasks_.end(), is_busy);
        for (Task& task : tasks_) {
            if (free <= 0) return;
            if (task.result || task.child) continue;
            if (is_of_device(task) && std::any_of(tasks_.begin(), tasks_.end(), is_busy_with_device)) continue;
            if (task.test->needs != nullptr) {
                const Task* const first = needed(task.test->needs, task.subject.name);
                if (first != nullptr && !first->result) continue;
                if (first != nullptr &&
                    (first->result->status == Status::failed || first->result->status == Status::skipped)) {
                    task.result = result_of(task, Status::skipped, std::string(task.test->needs) + " must pass first");
                    continue;
                }
            }
            const Limits limits{.cpu_seconds = task.test->cpu_limit, .wall_seconds = 4 * task.test->cpu_limit + 4};
            task.child = std::make_unique<Sandbox>([&] { return examined(path_, task); }, limits);
            --free;
        }
    }
    void wait() {
        std::vector<pollfd> waits;
        double longest = 1.0;
        for (const Task& task : tasks_)
            if (task.child != nullptr) {
                waits.push_back({task.child->descriptor(), POLLIN, 0});
                longest = std::min(longest, task.child->seconds_left());
            }
        if (waits.empty()) return;
        ::poll(waits.data(), waits.size(), std::max(1, static_cast<int>(1e3 * longest)));
        for (Task& task : tasks_)
            if (task.child != nullptr && task.child->poll()) task.result = result_of(task);
    }

    std::string path_;
    std::function<void(const TestResult&)> on_result_;
    std::vector<Task> tasks_;
};

}  // namespace

void run_tests(const std::string& path, const Selection& selection,
               const std::function<void(const std::string& plugin, const std::string& does_not)>& on_plugin,
               const std::function<void(const TestResult&)>& on_result) {
    const auto add = [&](const Test& test, const SubjectName& subject, std::vector<Task>& to) {
        if (test.level > selection.level) return;
        if (!selection.only.empty() && !matches(test.id, selection.only)) return;
        Task task{&test, subject};
        for (const auto& [pattern, reason] : selection.excluded)
            if (matches(test.id, pattern)) task.result = result_of(task, Status::skipped, "excluded: " + reason);
        to.push_back(std::move(task));
    };
    Schedule schedule(path, on_result);
    std::vector<Task> of_file, others;
    for (const Test& test : all_tests())
        if (test.scope == Scope::file) add(test, {}, of_file);
    schedule.run(std::move(of_file));

    Loaded loaded;
    std::string why_not;
    const std::vector<SubjectName> subjects = subjects_in(path, loaded, why_not);
    if (!loaded.plugin.empty()) on_plugin(loaded.plugin, loaded.does_not);
    const auto has = [&](Scope scope) {
        return std::any_of(subjects.begin(), subjects.end(), [&](const SubjectName& s) { return s.scope == scope; });
    };
    for (const Test& test : all_tests()) {
        if (test.scope == Scope::file) continue;
        // Few plugins have tools, strategies and devices: what one kind has not is no gap of the others'.
        const bool is_of_tools = test.scope == Scope::tool || test.scope == Scope::law;
        if ((test.scope == Scope::strategy || test.scope == Scope::device) && !has(test.scope)) continue;
        if (is_of_tools && (has(Scope::strategy) || has(Scope::device)) && !has(Scope::tool) && !has(Scope::law))
            continue;
        const std::size_t before = others.size();
        for (const SubjectName& subject : subjects)
            if (subject.scope == test.scope) add(test, subject, others);
        if (others.size() > before || subjects.empty()) {
            if (!subjects.empty()) continue;
            add(test, {}, others);
            if (others.size() > before && !others.back().result)
                others.back().result = result_of(others.back(), Status::skipped, why_not);
            continue;
        }
        add(test, {}, others);
        if (others.size() > before && !others.back().result)
            others.back().result =
                result_of(others.back(), Status::skipped,
                          test.scope == Scope::tool ? "the plugin has no tool" : "the plugin has no law");
    }
    schedule.run(std::move(others));
}

}  // namespace kerf::conformance
