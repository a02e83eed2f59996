// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "conformance/result.h"

/// A test of the conformance kit. Its body runs in a process of its own, so it may crash or hang.
namespace kerf::conformance {

struct Subject;

/// What a test's body reads and answers.
class Examination {
public:
    Examination(std::string plugin_path, const Subject* tested) : path(std::move(plugin_path)), subject(tested) {}

    const std::string path;        ///< of the plugin's file
    const Subject* const subject;  ///< null for a test of the file, which loads it itself

    /// The first failure counts, and no warning after it.
    void fail(const std::string& cause) { set(Status::failed, cause); }
    void warn(const std::string& cause) { set(Status::warned, cause); }
    void skip(const std::string& reason) { set(Status::skipped, reason); }
    /// A figure for the report of a test that passes.
    void note(const std::string& figure) {
        if (status_ == Status::passed) text_ = figure;
    }
    [[nodiscard]] Status status() const noexcept { return status_; }
    [[nodiscard]] const std::string& text() const noexcept { return text_; }
    [[nodiscard]] bool has_failed() const noexcept { return status_ == Status::failed; }

private:
    void set(Status status, const std::string& text) {
        if (status_ == Status::failed || (status_ == Status::warned && status != Status::failed)) return;
        status_ = status;
        text_ = text;
    }
    Status status_ = Status::passed;
    std::string text_;
};

/// What a test is about, and what is loaded for it.
enum class Scope {
    file,      ///< nothing is loaded
    plugin,    ///< the plugin, once
    tool,      ///< each tool
    law,       ///< each law, with each tool that it takes
    strategy,  ///< each remeshing strategy
    device     ///< each driver of devices
};

struct Test {
    const char* id;  ///< "law.finite"
    int level;       ///< 1 … 4
    Scope scope;
    const char* sentence;  ///< what is true of a plugin that passes
    void (*body)(Examination&);
    const char* needs = nullptr;  ///< a test that the subject, or the plugin as a whole, must not have failed
    int cpu_limit = 3;            ///< [s] of processor time
    std::uint32_t except = 0;     ///< KERF_DOES_NOT_…: skipped for a law that leaves this out
};

/// All tests, in the order in which they run: a test comes after the one it needs.   [any]
[[nodiscard]] std::span<const Test> all_tests();

}  // namespace kerf::conformance
