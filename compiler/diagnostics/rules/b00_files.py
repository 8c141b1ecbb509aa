"""B00: files and the command line."""

from __future__ import annotations

from .row import error

MISSING_FILE = error(
    "B0001",
    "there is no file `{path}`",
    "Check the path: it is taken relative to the folder the command is run in.",
)
NOT_A_FILE = error(
    "B0002",
    "`{path}` is a folder, not a file",
    "Name the `.burnish` files to compile; folders are not searched.",
)
UNREADABLE_FILE = error(
    "B0003",
    "`{path}` cannot be read: {reason}",
    "The system does not allow this file to be read. Check its name, its permissions, and those of "
    "the folders that it lies in.",
)
NOT_TEXT = error(
    "B0004",
    "`{path}` is not UTF-8 text: {reason}",
    "Burnish files are UTF-8 text. Save the file as UTF-8, or check that it is the file you meant.",
)
TOO_LARGE = error(
    "B0005",
    "`{path}` is larger than {limit}",
    "A material of this size is almost certainly not the file you meant. Generated text should be "
    "split into several files that import each other.",
)
MISSING_IMPORT = error(
    "B0006",
    "cannot find `{path}`",
    "`import std.lights` looks for `std/lights.burnish` along the search path; a quoted import is "
    "taken relative to the importing file.",
)
IMPORT_ESCAPES = error(
    "B0007",
    "`{path}` leads out of the search path",
    "Imports may not leave the folders of the search path: a material has to compile the same way "
    "wherever it is checked out. Move the file inside, or add its folder to the search path.",
)
IMPORT_CYCLE = error(
    "B0008",
    "these files import each other: {cycle}",
    "Imports must not form a cycle. Move what both files need into a third one.",
)
UNWRITABLE_OUTPUT = error(
    "B0009",
    "cannot write to `{path}`: {reason}",
    "The message says what is in the way. Missing folders are made where they are needed.",
)
UNKNOWN_TARGET = error(
    "B0010",
    "unknown target `{name}`",
    "`burnish targets` lists the known targets. Separate several targets by commas.",
)
UNKNOWN_PROFILE = error(
    "B0011",
    "target `{target}` has no profile `{name}`",
    "A profile is a version of a target's language, such as `glsl:es300`.",
)
UNKNOWN_EXPORT = error(
    "B0012",
    "`{path}` does not declare `{name}`",
    "Only what a file declares itself can be imported from it, not what it imports in turn.",
    of_absence=True,
)
MISSING_FOLDER = error(
    "B0013",
    "there is no folder `{path}` to look for imports in",
    "The search path consists of the folders that `--include` or `search_path=` names. Check "
    "their names.",
)
TOO_MUCH_IMPORTED = error(
    "B0014",
    "with `{path}`, the imported files are larger than {limit}",
    "A file and all that it imports are read as a whole. Import only what is used.",
)
TOO_MANY_DECLARED = error(
    "B0015",
    "`{path}` declares {count} {kinds}, and {most} are possible",
    "All that are not abstract are compiled together, and all others are checked together. Divide "
    "the file; what several files need belongs into one that they import.",
)
TOO_MUCH_UNUSED = error(
    "B0016",
    "with `{name}`, more than {most} characters of `{path}` would be tried",
    "A record that no shader uses is checked by trying it with a material and lights of the file, "
    "and with others until it is right; each try reads all that it extends. Divide the file.",
)
TOO_MUCH_TOGETHER = error(
    "B0017",
    "before `{name}`, what `{path}` declares has more than {most} operations",
    "All materials, kernels and frames that are not abstract are compiled together, each with all "
    "that it inherits and calls. Compile them one by one, by `--material`, or divide the file.",
)
SAME_OUTPUT = error(
    "B0018",
    "`{first}` and `{second}` would both write `{name}`",
    "Outputs are called by their materials and frames. Files that are compiled together have to "
    "declare different ones, also but for capital letters: rename one, or compile the files into "
    "two folders.",
)
SAME_BUT_FOR_CAPITALS = error(
    "B0019",
    "`{path}` would be written to `{first}` and to `{second}`, which are one file on many disks",
    "Outputs are called by their materials and frames. On the disks of Windows and macOS, names "
    "that differ in capital letters only are the same: rename one, or compile each into a folder "
    "of its own, by `--material`.",
)
FOREIGN_OUTPUT = error(
    "B0020",
    "`{path}` would be overwritten, and {reason}",
    "Nothing was written. Compile into another folder, rename the material or the frame, or "
    "overwrite all that is in the way by `--force`. What is changed by hand in an output belongs "
    "into its source.",
)
