// SPDX-License-Identifier: Apache-2.0
#include "core/procedure/codes.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <iterator>
#include <ranges>
#include <system_error>

#include "core/procedure/read_codes.h"

namespace kerf {
namespace {

constexpr CodeEntry entries[] = {
    // ---- the file and its YAML
    {101, "file cannot be read", "The file is missing, is a folder, or may not be read.",
     "Nothing can be said about a document that nobody has seen.",
     "Check the name and the folder you are in; a procedure names its anatomy from its own folder."},
    {102, "file too large", "The file is larger than 1 MB.",
     "No document needs that: it is most likely a scan or a recording under the wrong name.", "Name a YAML file."},
    {103, "not text", "The file holds bytes that are not UTF-8 text, or control characters.",
     "Letters outside ASCII would be read as others, and a document with invisible characters means something else "
     "than it shows.",
     "Save the file as UTF-8 in a text editor."},
    {104, "file says nothing", "The file is empty, or holds comments alone.", "There is nothing to read.",
     "Begin with `apiVersion: kerf/v1` and `kind: Procedure` or `kind: Anatomy`."},
    {105, "not YAML", "The text breaks the rules of YAML.",
     "From here on nobody can tell what belongs to what. Most often a line is indented wrongly, a quotation mark or "
     "bracket is not closed, or text holds `: `.",
     "Indent with spaces, like the neighbours; put text that holds `: ` or ` #` into quotation marks."},
    {106, "second document", "A second document begins in the same file.",
     "One file is one document, so that its name says which.",
     "Remove the second document, or put it into a file of its own."},
    {107, "nested too deep", "There are more than 64 levels of lists and maps.",
     "No document needs that; it protects the reader.", "Take some of the levels away."},
    {108, "duplicate key", "A map has the same key twice.",
     "Only one of the two could count, and a reader would not see which.",
     "Remove one. The first one is shown as well."},
    {109, "anchor or alias", "The text uses `&name` or `*name`.",
     "They hide where a value comes from: the place that a message shows would not be the place to mend.",
     "Repeat the value; or use `variants:` for documents that differ in a few values."},
    {110, "tag", "A value begins with `!`.", "What a value means follows from its key alone.",
     "Remove the tag, or put the value into quotation marks."},
    {111, "key is no word", "A key is empty, a list or a map.", "Keys are names.", "Put a word before the `:`."},
    {112, "more errors than shown", "There are more than 100 errors.", "The rest is most likely due to the first ones.",
     "Mend the first ones, and check again."},

    // ---- its structure
    {201, "another version", "`apiVersion` is not one that this Kerf reads.",
     "Keys may mean something else in another version.", "Write `apiVersion: kerf/v1`."},
    {202, "another kind", "The document is an anatomy where a procedure is needed, or the other way round.",
     "`kerf run` and `kerf validate` take procedures; a procedure's `anatomy:` and `--anatomy` take anatomies.",
     "Name another file, or mend `kind:`."},
    {203, "unknown key", "A map has a key that nothing reads.",
     "It would be silently without effect: a limit that nobody watches is worse than none.",
     "Correct the spelling or remove the key; the message lists what there is."},
    {204, "key is missing", "A map lacks a key that it needs.", "There is no value that would be right for everybody.",
     "Add it; the message shows one."},
    {205, "wrong shape", "The value has the wrong type, such as a list instead of a map.",
     "What is inside cannot be found.",
     "A map is `key: value`, a line for each, or `{key: value}`; a list has `- ` before each item, or is `[one, "
     "two]`."},
    {206, "nothing there", "A key has nothing behind it, or a list or map is empty.",
     "An empty value looks like one that was forgotten.", "Fill it, or remove the key."},
    {207, "unknown word", "A value is not one of the few words that are allowed here.",
     "It would be taken for something else, or for nothing.",
     "Write one of the words that the message lists. Only `true` and `false` mean yes and no."},
    {208, "name used twice", "Two things that must differ have the same name.",
     "What refers to the name would not know which is meant.",
     "Give one of them another name. The first one is shown as well."},
    {209, "malformed name", "A name or a version is written in a form that is not allowed.",
     "Names stand in files, on command lines and in results: they are one word of letters, digits, `.`, `_` and `-`. A "
     "version is three numbers.",
     "Write it in that form; titles may say it nicely."},
    {210, "path leads outside", "A path is absolute, or leaves the folders that Kerf searches for data.",
     "A document is handed on together with its folder; and it must not be able to reach for other files of whoever "
     "runs it.",
     "Put the file into the document's folder or into KERF_DATA, and write its path from there, with `/` between "
     "folders."},
    {211, "one of several", "Of several keys that exclude each other there are none, or several.",
     "The meaning is ambiguous.", "Keep exactly one of those that the message lists."},
    {212, "patch leads nowhere", "A path in a patch names something that is not there and cannot be made.",
     "A path enters maps by key and lists by the `id` of their items; a single value, and a list whose items have no "
     "ids, have nothing inside to name.",
     "Correct the path; replace the whole list where its items have no ids."},
    {213, "nothing to remove", "A patch removes something with `~` that is not there.",
     "It would be without effect: most likely its name is written wrongly, or what it named was renamed.",
     "Correct the path, or remove this line."},

    // ---- what it refers to
    {301, "unknown plugin", "No plugin of this name was found.",
     "Tools and forces come from plugins; without it there is nothing to simulate.",
     "Correct the spelling (`kerf list` shows what was found), or name the folder that holds the plugin in "
     "KERF_PLUGIN_PATH."},
    {302, "unknown tool", "The plugin has no tool of this name.", "There is nothing to hold.",
     "Write one of those that the message lists; `kerf list` shows all."},
    {303, "unknown force", "The plugin has no law of force of this name.", "There is nothing to feel.",
     "Write one of those that the message lists; `kerf list` shows all."},
    {304, "unknown parameter", "Neither the tool nor the force has a parameter of this name.",
     "It would be silently without effect.",
     "Write one of those that the message lists; `kerf describe` explains them."},
    {305, "unknown drive", "The tool has no drive of this name.",
     "It would be silently without effect: a drill that does not turn.",
     "Write one of those that the message lists; `kerf describe` explains them."},
    {306, "unknown instrument", "A step names an instrument that is not under `instruments:`.",
     "The hand would be empty.", "Write one of those that the message lists, or add it under `instruments:`."},
    {307, "zone not declared", "A limit names a zone that is not under `needs.zones`.",
     "A procedure lists all that it needs of an anatomy in one place, so that an anatomy can be checked against it.",
     "Correct the spelling, or add it to `needs.zones`."},
    {308, "landmark not declared", "A step names a landmark that is not under `needs.landmarks`.",
     "A procedure lists all that it needs of an anatomy in one place, so that an anatomy can be checked against it.",
     "Correct the spelling, or add it to `needs.landmarks`."},
    {309, "no such limit", "A rehearsal expects a limit to break that no step has.", "It could never end as it says.",
     "Name the zone of a limit, or its quantity where it has no zone; or add the limit."},
    {310, "instrument not used", "No step uses an instrument.",
     "Most likely a step names another one by mistake. Only a warning.", "Remove it, or name it in a step.", true},
    {311, "unknown variant", "The procedure has no variant of this name.",
     "Running the procedure as it is instead would be recorded as something that it is not.",
     "Write one of those that the message lists."},
    {312, "unknown step", "A waypoint of a rehearsal is seen from a step that there is not.",
     "Nobody can tell along which axis its depth counts.", "Write one that the message lists."},
    {313, "unknown implant", "A waypoint brings in an implant that the procedure does not have.",
     "Nobody can tell what its surface is.", "Write one that the message lists, or add it under `implants:`."},

    // ---- its numbers
    {401, "not a number", "The value is not a number.",
     "Numbers have a decimal point, whatever the language of the computer, and no signs for thousands.",
     "Write a number, and its unit behind it."},
    {402, "unit is missing", "A number has no unit.",
     "3.2 could be millimetres or centimetres: guessing is how patients come to harm.",
     "Write the unit behind the number, as in `3.2 mm`."},
    {403, "unknown unit", "The unit is unknown.", "The value cannot be converted.",
     "Write a unit of the kind that the message names; `mm/s`, `g/cm3`, `N/mm^2` and the like are made of known ones."},
    {404, "unit of another kind", "A value is, for example, a force where a speed is needed.",
     "It can only be a mistake.", "Write a value of the kind that the message names."},
    {405, "not three numbers", "A place or direction is not three numbers.", "All of x, y and z are needed.",
     "Write three numbers with blanks between them and one unit behind, as in `3.0 193.0 -60.5 mm`; a direction has no "
     "unit."},
    {406, "bound without an end",
     "A goal or limit has neither `at_least` nor `at_most`, or a pair that nothing fulfils.",
     "It would always hold, or never.", "Write one of them, or both in the right order."},
    {407, "degenerate",
     "A solid, an axis or a shell has no extent where it needs one, or something is given twice over.",
     "There would be no direction, no volume, or two answers.",
     "Follow the message: it names what has to move, or go."},
    {408, "goal against limit",
     "A goal lies beyond a limit of its step, or two limits or goals of a step exclude each other.",
     "An operator who does what the procedure requires would fail by it.",
     "Write a goal within the limit, or move the limit; both places are shown."},
    {412, "out of range", "A value lies outside what is possible or plausible here.",
     "Most often the decimal point or the unit slipped. Where the range is a plugin's, it says for what its model was "
     "made.",
     "Write a value within the range that the message shows; `kerf describe` prints those of plugins."},
    {413, "too fine", "At this spacing the bone would take more memory than is allowed.",
     "Halving the spacing takes up to eight times the memory; running out of it in the middle of a run would lose the "
     "run.",
     "Write the spacing that the message names, or a coarser one."},

    // ---- what the procedure needs of the anatomy
    {501, "landmark missing in the anatomy", "The anatomy has no landmark of a name that the procedure needs.",
     "The step could not find its way.", "Correct the spelling, add it to the anatomy, or choose another anatomy."},
    {502, "zone missing in the anatomy", "The anatomy has no zone of a name that the procedure needs.",
     "What must be spared could not be watched.",
     "Correct the spelling, add it to the anatomy, or choose another anatomy."},
    {503, "tissue missing in the anatomy", "The anatomy has no tissue of a name that the procedure needs.",
     "The procedure was written for bone that has it.",
     "Correct the spelling, add it to the anatomy, or choose another anatomy."},
    {504, "point instead of an axis", "A step follows a landmark that is a point.", "A point has no direction.",
     "Name an axis, or give the anatomy one."},
    {505, "no midline", "A rehearsal moves towards the midline, but the anatomy has no point landmark `midline`.",
     "Nobody can tell which way `medial:` and `medial_angle:` go.",
     "Add `midline` to the anatomy's points, or remove them."},
    {506, "no plane", "The `plane:` of a step is a point or an axis of the anatomy.",
     "Neither says how a blade is to be turned.", "Name a plane, or give the anatomy one."},
    {507, "axis out of its plane",
     "A step's axis leads out of the plane that its blade should lie in, or runs beside it.",
     "A blade that is fed across its own plane binds in its slot.",
     "Turn or move the axis or the plane in the anatomy."},
    {508, "step without a plane", "Something is measured in the plane of a step that names none.",
     "Without one a blade may be turned anyhow about its axis.",
     "Give the step a `plane:`, the name of a landmark plane."},
    {509, "no piece yet", "A step takes a piece away, and no step before it parts the bone.",
     "Nobody takes the whole bone: there is nothing to hold yet, and the step could never be done.",
     "Put a step with the goal `{separated: {}}` before it."},

    // ---- bone and data files
    {601, "phantom without bone", "No part of the phantom adds bone.", "There is nothing to cut.",
     "Give `phantom.parts` at least one part without `subtract`."},
    {602, "bone too large",
     "The bone at this spacing, or the part of the scan around the axes, takes more memory or more bricks than one may "
     "have.",
     "It is refused before any of it is taken.",
     "Write the `accuracy.spacing` that the message names, or give axes that go no farther than what is planned."},
    {610, "axis meets no bone", "A planned axis does not meet bone anywhere.",
     "Most often its points are in another frame (RAS instead of LPS), in another unit, or of another patient.",
     "Check its points: LPS, millimetres, from outside into the bone."},
    {611, "axis mostly outside bone", "Less than 80 % of a planned axis behind its entry lies in bone.",
     "A plan that runs through air is most likely not meant, or the bone was not found whole.",
     "Check its points, and the threshold or labels."},
    {612, "left and right exchanged", "A landmark that is called left lies to the right of one that is called right.",
     "Everything may be mirrored: coordinates in RAS read as LPS look just so.",
     "Exchange the two; or turn the sign of every x and y, if all are RAS."},
    {613, "landmark elsewhere", "A point does not lie on, in or off the bone as its `lies:` says.",
     "Either the point or the bone is not where it should be.",
     "Check its coordinates, its `lies:`, and the threshold or unit that the bone is made with."},
    {614, "zone in bone", "Much of a zone lies in bone.",
     "What must be spared is most often soft; a zone in bone may be in another frame. Only a warning.",
     "Check its coordinates: LPS, millimetres.", true},
    {619, "link out of the folder", "A link to a data file leads out of the folder that it must stay in.",
     "A document or header from elsewhere could show any file of this machine.",
     "Put the file itself into the document's folder, or into the one that KERF_DATA names."},
    {620, "data file cannot be read", "A file that a document names is missing, or may not be read.",
     "There is no bone without it.",
     "Check its name; Kerf searches what a document names in the document's folder, then in the folder that the "
     "environment variable KERF_DATA names, as in `export KERF_DATA=/home/me/data`."},
    {621, "unknown format", "The name of an image ends in none of the known endings.", "What is inside is not guessed.",
     "Export it as .nii.gz, .nrrd or .mha, or name a folder with a DICOM series."},
    {622, "malformed header", "The header of an image breaks its format, or needs a feature that Kerf does not read.",
     "Reading on would be guessing.", "Export the image again as one .nii.gz, .nrrd or .mha."},
    {623, "not a volume of numbers", "An image does not have three dimensions and one number per voxel.",
     "Bone is found by one value per voxel.", "Export a single volume with a single channel."},
    {624, "image of impossible size",
     "An axis of an image has fewer than 2 or more than 4096 voxels, or there are too many in all.",
     "A small file that claims a large image must not take all memory.", "Crop the image."},
    {625, "voxels of another type", "The voxels are of a type, or packed in a way, that is not read.",
     "They would be read as other numbers.", "Export the image with whole or floating point numbers, raw or gzip."},
    {626, "image is cut short", "An image has fewer or more bytes than its header promises, or they are damaged.",
     "What is missing would be air; a wrong size in the header scrambles all voxels.",
     "Copy or export the file again."},
    {627, "image without a place",
     "Spacing, orientation or frame of an image cannot be used, or is given twice and differs.",
     "Left and right could be exchanged.", "Export the image again, with its orientation."},
    {628, "image changed while it was read",
     "When the voxels were read, the file was another one than when its header was checked; or there was no memory for "
     "them.",
     "Half of one file and half of another are no image.",
     "Wait until whatever writes the file has ended, and try again; export a part of it if memory is short."},
    {629, "voxel without a value", "A voxel is no finite number.", "It is neither bone nor air.",
     "Fill such voxels with the value of air, and export again."},
    {630, "label map elsewhere", "The label map covers nothing of the region, or does not lie where the image does.",
     "Labels would be taken from another place.", "Export the label map of the same scan."},
    {631, "axes outside the image", "The landmarks' axes lie outside the image.",
     "Most often they are in another frame (RAS instead of LPS) or of another patient.",
     "Check the landmarks and the image."},
    {632, "sheared image", "The axes of the image's slices are not at right angles.",
     "Kerf keeps bone on a grid with right angles; mending it means making up values.",
     "Export the image resampled to right angles."},
    {633, "no bone", "No voxel around the axes is bone.", "There is nothing to cut.",
     "Lower `ct.threshold`, or check `ct.labels.keep`."},
    {634, "no bone at the landmark", "There is no bone near the landmark that says which piece to keep.",
     "Another piece would be taken for it.", "Move the landmark onto the bone, or lower the threshold."},
    {635, "unknown structure", "The segmentation has no structure of a name under `keep`.", "There would be no bone.",
     "Write a name that the message lists, or the label's number."},
    {636, "ambiguous structure",
     "Several structures of a segmentation have the same name or label, or one cannot be told from another.",
     "The wrong structure could become the bone.",
     "Keep one by a name or number that no other has; or rename them in 3D Slicer and export again."},
    {640, "surface cannot be read", "The file of a surface is missing, is no regular file, or may not be read.",
     "There is no bone without it.",
     "Check its name; Kerf searches what a document names in the document's folder, then in the folder that the "
     "environment variable KERF_DATA names, as in `export KERF_DATA=/home/me/data`."},
    {641, "unknown format of a surface", "The name of a surface ends in none of .stl, .obj and .ply.",
     "What is inside is not guessed.", "Export it as one of them."},
    {642, "surface too large", "A surface has more faces or vertices than can be kept.",
     "Memory has an end, and bone needs no such detail.", "Export it with fewer faces, or cut out the bone."},
    {643, "malformed surface", "The file of a surface breaks its format.", "Reading on would be guessing.",
     "Export the surface again, as binary STL or PLY."},
    {644, "surface is cut short", "The file of a surface ends before what it promises.",
     "What is missing would be a hole.", "Copy or export it again."},
    {645, "vertex without a place", "A vertex of a surface is no finite place.", "Its faces would be nowhere.",
     "Export the surface again."},
    {646, "face without a corner", "A face names a vertex that is not there.", "It has no shape.",
     "Export the surface again."},
    {647, "no face", "A surface has no face that bounds an inside.",
     "There is no bone without an inside; a sheet without thickness has none.",
     "Export the closed surface; point clouds are not read."},
    {648, "surface of odd size", "A surface is as long as no bone is.",
     "Its unit is most likely another: no such file says it. Only a warning.",
     "Write `mesh.unit:` as the message says.", true},
    {649, "surface is open", "A surface has holes that were not allowed to be closed.",
     "Nobody can tell what is inside.",
     "Close it where it was made; or allow holes of that size to be closed with `repair:`."},
    {650, "crowded edge", "More faces meet at an edge than have a common inside.",
     "Inside and outside cannot be distinguished there.", "Mend the surface in the program that made it."},
    {651, "surface with one side", "The faces cannot all look outwards.", "It has no inside.",
     "Mend the surface in the program that made it."},
    {652, "axes outside the surface", "The landmarks' axes lie outside the surface.",
     "Most often the surface is in another frame or unit, or of another patient.",
     "Check the axes, `mesh.unit` and `mesh.frame`."},
    {653, "doubtful inner piece", "A piece of the surface lies inside another, with bone on both sides by its faces.",
     "It may be a cavity or a leftover; which of them changes the force.", "Say which with `repair: {inner: …}`."},
    {654, "frame or unit contradicted",
     "The header of a surface names another frame or unit than the document, or one that is not known.",
     "Left and right could be exchanged, or sizes be wrong by a factor of ten.",
     "Remove `frame:` or change `unit:` if the header is right; otherwise correct the header."},
    {655, "thin plate", "A plate of bone, with air on both sides, is thinner than this spacing can carry.",
     "It would feel too soft, or not be there: a third of it is the coarsest spacing that carries it.",
     "Write the spacing that the message names, or make the plate thicker."},
    {656, "crossing faces", "Faces of the surface cut through one another near the axes.",
     "Bone may feel thin there. Only a warning.", "Join the parts into one surface in the program that made them.",
     true},
    {657, "coarse numbers", "A surface lies so far from the origin that its file's numbers are coarse.",
     "Its faces are where those numbers allow, and not where they should be. Only a warning.",
     "Move it to the origin where it was made, and export it again.", true},
    {658, "thin spur", "On less than a thousandth of the surface the bone is thinner than this spacing can carry.",
     "There it feels too soft, or is not there. Only a warning.", "Write a finer spacing, or do without that place.",
     true},
    {660, "no slice", "A folder holds no DICOM slice.", "There is nothing to make an image of.",
     "Name the folder that holds the slices."},
    {661, "several series", "A folder holds several series, and none was chosen.",
     "The wrong one could be of another kernel, another time, or another patient.",
     "Write `series:` with one that the message offers."},
    {662, "unknown series", "The folder holds no series of that name.", "Another one is not taken instead.",
     "Write one that the message offers."},
    {663, "slices that differ", "Slices of a series differ in size, orientation, spacing or frame of reference.",
     "They are not of one volume.", "Export the series alone."},
    {664, "two slices in one place", "Two slices of a series lie in the same place.",
     "The right one is unknown: there may be two times or two reconstructions.", "Export one of them alone."},
    {665, "slices are missing", "There are gaps between the slices of a series.",
     "What was there is not known; filling it means making up bone.",
     "Copy the missing slices; or let the gaps be filled by allowing it, and read what was filled in the notes."},
    {666, "slices not in a row", "The slices do not lie one behind the other.", "They make no volume.",
     "Export a single axial series."},
    {667, "slice that cannot be used", "A slice lacks something in its header, or its pixels are no grey values.",
     "Its place or its values would be guessed.", "Export the series again from the scanner or archive."},
    {668, "damaged slice", "A DICOM file is damaged.", "What is missing in it would be guessed.",
     "Copy the file again."},
    {669, "too few slices or too many voxels", "The series has too few slices, or too many voxels in all.",
     "A volume needs slices in a row, and memory has an end.", "Name the whole series, or crop it."},
    {670, "folder cannot be read", "A folder of slices cannot be read, or holds more than 20000 files.",
     "A folder of that size is an archive and not a series.", "Name the folder of the one series."},
    {671, "tilted slices", "The slices slide against each other, as under a tilted gantry; they were put straight.",
     "Every value is a mean of its neighbours then, and edges are softer by up to a pixel. Only a warning.",
     "Compare the bone with the scan; or export the series with the tilt taken out.", true},
    {672, "uneven slices",
     "The slices do not lie evenly, or gaps were filled as allowed; values in between were interpolated.",
     "Bone in a filled gap was never measured. Only a warning.",
     "Check whether a planned way leads through such a gap.", true},
    {673, "doubtful series",
     "Something in the header makes the values or the place doubtful: another modality, lossy compression, a tilt or "
     "distance that the positions do not show, several acquisitions one behind the other.",
     "Forces follow the densities, and densities the values. Only a warning.", "Check the series at its source.", true},
    {674, "voxels cannot be decoded", "The voxels of a slice cannot be decoded.", "They would be air, or noise.",
     "Export the series uncompressed, or copy it again."},
    {675, "doubtful values", "The values around the axes are hardly HU, or metal shines in them.",
     "A threshold in HU means something else on grey levels, and streaks of metal look like bone. Only a warning.",
     "Write `intensity: grey` for cone-beam CT and set the threshold by the scan itself; look at the bone near metal.",
     true},
    {676, "several acquisitions", "A series holds several acquisitions of the same part of the patient.",
     "Slices before and after contrast, or of two voltages, would be mixed.",
     "Write `acquisition:` with one that the message offers."},
    {677, "unknown acquisition", "The series holds no acquisition of that name.", "Another one is not taken instead.",
     "Write one that the message offers."},
    {680, "malformed markups", "A file of markups is not one that 3D Slicer writes, or has a value of another form.",
     "Its places would be guessed.", "Save the markups from 3D Slicer again, as .mrk.json or .fcsv."},
    {681, "markups without a frame",
     "A file of markups does not say whether it is RAS or LPS, or is not in millimetres.",
     "Left and right could be exchanged.", "Save the markups from 3D Slicer again, as .mrk.json."},
    {682, "markup that is no landmark", "A markup is neither points, a line nor a plane, or lacks a place.",
     "A procedure could not use it.", "Place it in 3D Slicer, or delete it there."},
    {683, "markup's name", "The name of a markup is no id, or there is another landmark of that name.",
     "Procedures name landmarks by one word each.", "Give it another id under `names:`."},

    // ---- what it asks of a run
    {701, "unknown device", "There is no record of a device of this name.",
     "The greatest force, mass and friction of the device decide the scale of what is felt.",
     "Write one that the message lists."},
    {702, "too many tools", "More instruments are in use than a run lays out.",
     "Each is kept ready from the start; a run has room for eight.",
     "Use one for several steps, or make two procedures of it."},
    {703, "impossible tool", "The plugin refuses a tool with these parameters.",
     "Each value is within its range, but together they make no tool.",
     "Follow the plugin's own words in the message; `kerf describe` explains the parameters."},
    {704, "rehearsal without a way", "A rehearsal has fewer than two waypoints.",
     "It needs to start somewhere and to go somewhere.", "Add a waypoint."},
    {705, "rehearsal starts in bone", "The first waypoint of a rehearsal is inside the bone.",
     "The tool cannot appear in the middle of bone: it must come there.",
     "Let it start outside, as in `- {depth: -5 mm}`."},
    {706, "narrow kerf", "A saw's kerf is narrower than two voxels.",
     "Its slot would be lost between samples: volumes go wrong, and the blade feels walls that are not where it cut. "
     "Only a warning.",
     "Write the spacing that the message gives.", true},
    {707, "blade beyond region", "A saw's blade does not fit into the region in which bone can be cut.",
     "It would stand against the region's border as against a wall.",
     "Take a smaller blade, or plan the axis so that the region is larger."},
    {708, "narrow hole", "A turning tool's hole is narrower than four voxels.",
     "A wall so sharply bent is not known where it is: the tool meets bone that it has cut, with newtons in three "
     "voxels and hundreds in two. Only a warning.",
     "Write the spacing that the message gives.", true},
    {709, "hand held by friction", "A rehearsal's hand pushes the device less than its own friction holds it.",
     "Forces are scaled down until the hardest bone, at the fastest feed, fits the device; so is the push, and the "
     "hand would stand where it starts. Only a warning.",
     "Write a larger `push:` or a slower `feed:`.", true},
    {710, "waypoint beyond region", "A rehearsal leads the tool into bone beyond the region in which bone can be cut.",
     "Of a scan or a surface only what lies within 15 mm around the planned axes is read; beyond it bone is like a "
     "wall, and the hand stops there. Only a warning.",
     "Keep the waypoint within the region, or give the anatomy an axis that leads as far.", true},
    {711, "too slow to cut", "A tool is commanded to go, but more slowly than it cuts.",
     "It would rub on the bone, and the hand push for nothing, or press it into what is weak. Only a warning.",
     "Write the speed that the message gives, or more; or 0 to switch it off.", true},
    {712, "short of its goal",
     "A rehearsal expects to pass, and its waypoints lead less deep than a goal of their step.",
     "A rehearsal is how a procedure shows that it can be done; this one would end otherwise than it says. Only a "
     "warning.",
     "Write the depth that the message gives, or more; or, under `expect:`, how it fails.", true},
    {713, "short of time", "A rehearsal expects to pass, and its hand needs longer than a run lasts.",
     "The run would end on the way, and the rehearsal otherwise than it says. Only a warning.",
     "Write a longer `time_limit:`, or a faster `approach:` or `feed:`.", true},
    {714, "no force scale",
     "None of the tools cuts with the drives that it is given, and no `force_scale:` is written.",
     "The scale is made to fit what cutting takes; without that it is 1, and the device cannot push as hard as an awl "
     "or a still drill needs. Only a warning.",
     "Write a `force_scale:` under `haptics:`: what the hand can hold on the device over what the tool will take in "
     "the bone.",
     true},
};

/// `text` in lines of at most 100 characters, each after `indent`.
std::string wrapped(std::string_view text, std::string_view indent) {
    std::string out(indent);
    std::size_t column = indent.size();
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(' '), text.size());
        const bool is_first = column == indent.size();
        if (column + 1 + end > 100 && !is_first) {
            out.append("\n").append(indent);
            column = indent.size();
        } else if (!is_first) {
            out += ' ';
            ++column;
        }
        out.append(text.substr(0, end));
        column += end;
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return out + "\n";
}

std::string text_of(const CodeEntry& entry) {
    return code_text(static_cast<Code>(entry.number), entry.is_warning ? 'W' : 'E');
}

}  // namespace

std::span<const CodeEntry> all_codes() noexcept { return entries; }

const CodeEntry* find_code(std::string_view text) noexcept {
    if (text.starts_with('E') || text.starts_with('W') || text.starts_with('e') || text.starts_with('w'))
        text.remove_prefix(1);
    int number = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (failure != std::errc{} || end != text.data() + text.size()) return nullptr;
    const auto found = std::ranges::find(entries, number, &CodeEntry::number);
    return found != std::end(entries) ? found : nullptr;
}

std::string explanation_of(const CodeEntry& entry) {
    return text_of(entry) + "  " + entry.name + "\n\n" + wrapped(entry.meaning, "  ") + "\n  Why it matters\n" +
           wrapped(entry.why, "    ") + "\n  What to do\n" + wrapped(entry.write, "    ");
}

std::string list_of_codes() {
    std::string text;
    for (const CodeEntry& entry : entries) text += text_of(entry) + "  " + entry.name + "\n";
    return text;
}

}  // namespace kerf
