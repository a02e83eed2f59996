// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/command_table.h"
#include "app/exit_code.h"
#include "app/installation.h"
#include "app/options.h"
#include "core/plugin/loader.h"

namespace kerf::app {

class RunDisplay;

/// The plugins and files that a command works with.
struct Environment {
    const PluginRegistry& plugins;
    const Installation& here;
    RunDisplay* display = nullptr;  ///< of kerf-window; null: the program has none
};

/// The commands that are part of `kerf`. Each prints its result and returns how the program ends.   [main]
namespace commands {

[[nodiscard]] ExitCode run(const RunOptions& options, const Environment& with);
[[nodiscard]] ExitCode watch(const RunOptions& options, const Invocation& call);
[[nodiscard]] ExitCode validate(const ValidateOptions& options, const Environment& with);
[[nodiscard]] ExitCode rehearse(const RehearseOptions& options, const Environment& with);
[[nodiscard]] ExitCode expand(const ExpandOptions& options, const Environment& with);
[[nodiscard]] ExitCode preview(const PreviewOptions& options, const Environment& with);
[[nodiscard]] ExitCode explain(const ExplainOptions& options, const Environment& with);
[[nodiscard]] ExitCode print_schema(const SchemaOptions& options, const Environment& with);
[[nodiscard]] ExitCode import(const ImportSourceOptions& options, const Environment& with);
[[nodiscard]] ExitCode anatomy(const AnatomyOptions& options, const Environment& with);
[[nodiscard]] ExitCode report(const ReportOptions& options, const Environment& with);
[[nodiscard]] ExitCode remesh(const RemeshOptions& options, const Environment& with);
[[nodiscard]] ExitCode view(const ViewOptions& options, const Environment& with);
[[nodiscard]] ExitCode print_privacy(const PrivacyOptions& options, const Environment& with);
[[nodiscard]] ExitCode list(const ListOptions& options, const Environment& with);
[[nodiscard]] ExitCode devices(const DevicesOptions& options, const Environment& with);
[[nodiscard]] ExitCode describe(const DescribeOptions& options, const Environment& with);
[[nodiscard]] ExitCode begin_folder(const NewOptions& options, const Environment& with);
[[nodiscard]] ExitCode print_completion(const CompletionOptions& options);
[[nodiscard]] ExitCode print_man_page(const ManOptions& options);

}  // namespace commands
}  // namespace kerf::app
