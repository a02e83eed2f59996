// SPDX-License-Identifier: Apache-2.0
#include "app/table/parameters.h"
#include "app/table/rows.h"

namespace kerf::app::table {

std::vector<Command> bone_commands() {
    std::vector<Command> rows;
    {
        using T = ImportSourceOptions;
        rows.push_back(
            {.name = "import",
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
                         flag("--allow-resample", "Fill gaps between slices from their neighbours",
                              in<T>(&T::may_resample)),
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
             .run = with_environment(&commands::import)});
    }
    {
        using T = AnatomyOptions;
        rows.push_back(
            {.name = "anatomy",
             .group = "Bones",
             .summary = "`kerf anatomy check A.yaml --for P.yaml`: check an anatomy with its bone and a procedure",
             .arguments = {{.name = "ACTION",
                            .value = one_of("", {"check"}),
                            .help = "check",
                            .is_required = true,
                            .member = in<T>(&T::action)},
                           {.name = "ANATOMY",
                            .value = yaml(),
                            .help = "YAML file of the anatomy",
                            .is_required = true,
                            .member = in<T>(&T::anatomy)}},
             .options = {{.name = "--for",
                          .value = yaml("PROCEDURE"),
                          .help = "Procedure that the anatomy is for",
                          .is_required = true,
                          .member = in<T>(&T::procedure)},
                         format_of<T>({"text", "json", "github"}, "text (default), json or github")},
             .when_missing =
                 "which anatomy, for which procedure? Write `kerf anatomy check ANATOMY.yaml --for PROCEDURE.yaml`.",
             .examples = {{"kerf anatomy check my-bone.yaml --for pedicle-screw.yaml",
                           "checks your anatomy with a shipped procedure"}},
             .footer = "Exit code: 0 clean, 2 errors.",
             .defaults = T{},
             .run = with_environment(&commands::check_anatomy)});
    }
    return rows;
}

}  // namespace kerf::app::table
