// SPDX-License-Identifier: Apache-2.0
#include "app/table/parameters.h"
#include "app/table/rows.h"
#include "documents/made/bone_kind.h"

namespace kerf::app::table {
namespace {

/// Returns the kinds of bones that have levels, and these: "of a vertebra T11, T12".
std::string text_of_levels() {
    std::string text;
    for (const documents::BoneKind& kind : documents::bone_kinds()) {
        if (kind.levels.empty()) continue;
        text += (text.empty() ? "of a " : "; of a ") + kind.name;
        for (const std::string& level : kind.levels) text += (&level == &kind.levels.front() ? " " : ", ") + level;
    }
    return text;
}

Command import_command() {
    using T = ImportSourceOptions;
    return {
        .name = "import",
        .group = "Bones",
        .summary = "Check a scan or a surface: its properties, the processing, and doubts",
        .arguments = {{.name = "SOURCE",
                       .value = file("the name of a file or folder"),
                       .help = "NIfTI, NRRD, MetaImage, a folder with DICOM; or STL, OBJ, PLY",
                       .is_required = true,
                       .member = in<T>(&T::source)}},
        .options = {out_of<T>(file("a file, as in `--out bone.nrrd`"),
                              "Write the processed data: .nrrd for a scan, .stl for a surface"),
                    {.name = "--series",
                     .value = text("SERIES", "a name that import offers"),
                     .help = "Series of a folder that holds several",
                     .member = in<T>(&T::series)},
                    {.name = "--acquisition",
                     .value = text("ACQUISITION", "a name that import offers"),
                     .help = "Which acquisition of a series that shows the same part several times",
                     .member = in<T>(&T::acquisition)},
                    flag("--allow-resample", "Fill gaps between slices from their neighbours", in<T>(&T::may_resample)),
                    {.name = "--unit",
                     .value = one_of("UNIT", {"mm", "cm", "m", "um"}),
                     .help = "Unit of a surface's coordinates: mm (default), cm, m or um",
                     .default_value = "mm",
                     .member = in<T>(&T::unit)},
                    {.name = "--frame",
                     .value = one_of("FRAME", {"LPS", "RAS"}),
                     .help = "Frame of a surface: LPS or RAS",
                     .default_value = "what the file names, or else LPS",
                     .member = in<T>(&T::frame)}},
        .when_missing = "what? Write `kerf import SCAN`, with a file or a folder.",
        .examples = {{"kerf import ct/ --out bone.nrrd", "checks a folder with DICOM and writes one image"},
                     {"kerf import femur.stl --unit cm", "checks a surface in centimetres"}},
        .footer = "Exit code: 0 usable, 2 refused.",
        .defaults = T{},
        .run = with_environment(&commands::import)};
}

Command anatomy_command() {
    using T = AnatomyOptions;
    return {.name = "anatomy",
            .group = "Bones",
            .summary = "Check an anatomy with its bone and a procedure, or make one from published dimensions",
            .arguments = {{.name = "ACTION",
                           .value = one_of("", {"check", "make"}),
                           .help = "check or make",
                           .is_required = true,
                           .member = in<T>(&T::action)},
                          {.name = "ANATOMY",
                           .value = yaml(),
                           .help = "check: YAML file of the anatomy; make: the kind of bone, as in `vertebra`",
                           .is_required = true,
                           .member = in<T>(&T::anatomy)}},
            .options = {{.name = "--for",
                         .value = yaml("PROCEDURE"),
                         .help = "check: also what this procedure needs of the anatomy",
                         .member = in<T>(&T::procedure)},
                        format_of<T>({"text", "json", "github"}, "check: text (default), json or github"),
                        {.name = "--level",
                         .value = one_of("LEVEL", documents::made_levels()),
                         .help = "make: level " + text_of_levels(),
                         .member = in<T>(&T::level)},
                        {.name = "--sex",
                         .value = one_of("SEX", {"f", "m"}),
                         .help = "make: f or m",
                         .default_value = "drawn with a seed; otherwise the mean of both",
                         .member = in<T>(&T::sex)},
                        {.name = "--height",
                         .value = text("HEIGHT", "a length, as in `--height \"165 cm\"`"),
                         .help = "make: of the person; sizes follow it",
                         .member = in<T>(&T::height)},
                        {.name = "--age",
                         .value = text("YEARS", "a number of years, as in `--age 70`"),
                         .help = "make: of the person; the density follows it",
                         .default_value = "45",
                         .member = in<T>(&T::age)},
                        flag("--osteoporosis", "make: with the density of osteoporosis", in<T>(&T::is_osteoporotic)),
                        settings_of<T>("make: Set a dimension, as in `--set pedicle.width=6mm`; may be repeated"),
                        {.name = "--seed",
                         .value = text("SEED", "a whole number, as in `--seed 7`"),
                         .help = "make: number of the person whose bone is drawn",
                         .default_value = "none: mean dimensions",
                         .member = in<T>(&T::seed)},
                        out_of<T>(file("a file, as in `--out bone.yaml`", ".yaml"),
                                  "make: write the anatomy to this file", "standard output")},
            .when_missing = "what? Write `kerf anatomy check ANATOMY.yaml`, or `kerf anatomy "
                            "make vertebra --level L3`.",
            .examples = {{"kerf anatomy check my-bone.yaml --for pedicle-screw.yaml",
                          "checks your anatomy with a shipped procedure"},
                         {"kerf anatomy make vertebra --level L4 --seed 7 -o made.yaml",
                          "draws the fourth lumbar vertebra of person 7"}},
            .footer = "Exit code: 0 clean, 2 errors.",
            .defaults = T{},
            .run = with_environment(&commands::anatomy)};
}

Command landmarks_command() {
    using T = LandmarksOptions;
    return {
        .name = "landmarks",
        .group = "Bones",
        .summary = "Pick landmarks of a bone by clicks in a window, or by rays, and write them into its anatomy",
        .arguments = {{.name = "ANATOMY",
                       .value = yaml(),
                       .help = "YAML file of the anatomy; it needs no landmarks yet",
                       .is_required = true,
                       .member = in<T>(&T::anatomy)}},
        .options = {{.name = "--point",
                     .value = text("NAME=RAY", "a name and a ray, as in `--point \"tip=0 80 0 mm, 0 0 0 mm\"`"),
                     .help = "Pick a point: where a ray from one point through another meets the bone, as in "
                             "`--point \"tip=0 80 0 mm, 0 0 0 mm\"`; may be repeated",
                     .member = in<T>(&T::points)},
                    {.name = "--axis",
                     .value = text("NAME=RAY;RAY", "a name and two rays, with `;` between them"),
                     .help = "Pick an axis by two rays, where it begins and where it ends; may be repeated",
                     .member = in<T>(&T::axes)},
                    flag("--write", "Write them into the file, in place of a window or standard output",
                         in<T>(&T::is_written)),
                    {.name = "--spacing",
                     .value = text("SPACING", "a length, as in `--spacing \"0.25 mm\"`"),
                     .help = "Spacing of the bone's grid",
                     .default_value = "0.5 mm, finer for thin bone, coarser for a large one",
                     .member = in<T>(&T::spacing)},
                    {.name = "--screenshot",
                     .value = file("the name of a picture, as in `--screenshot landmarks.png`", ".png"),
                     .help = "Write a picture and end; needs no display",
                     .member = in<T>(&T::screenshot)},
                    {.name = "--side",
                     .value = one_of("SIDE", {"oblique", "front", "back", "left", "right", "head", "foot"}),
                     .help =
                         "Side from which the picture shows the bone: oblique, front, back, left, right, head or foot",
                     .default_value = "oblique",
                     .member = in<T>(&T::side)}},
        .when_missing = "of which bone? Write `kerf landmarks ANATOMY.yaml`.",
        .examples = {{"kerf landmarks my-bone.yaml", "shows the bone; each click is a point on its surface"},
                     {"kerf landmarks my-bone.yaml --point \"tip=0 80 0 mm, 0 0 0 mm\"",
                      "prints a point as YAML, without a window"}},
        .footer = "Without `--point`, `--axis` and `--screenshot` a window opens.\nExit code: 0 done, 2 bad input, "
                  "3 fault or no display.",
        .defaults = T{},
        .run = [](const Options&, const Invocation& call) { return become_window(call.here, call.argv); }};
}

}  // namespace

std::vector<Command> bone_commands() { return {import_command(), anatomy_command(), landmarks_command()}; }

}  // namespace kerf::app::table
