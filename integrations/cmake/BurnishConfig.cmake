# Finds Burnish for `find_package(Burnish)`, and declares burnish_add_materials().
#
# `burnish integration cmake --path` prints the folder of this file, which is the value of
# Burnish_ROOT. The cache variable BURNISH_EXECUTABLE is the command that compiles; it is looked for
# on PATH.

# The policies that the function below works by, whatever those of its callers are.
cmake_policy(VERSION 3.25)

find_program(BURNISH_EXECUTABLE burnish DOC "The command of Burnish, which compiles materials")
mark_as_advanced(BURNISH_EXECUTABLE)
if(NOT BURNISH_EXECUTABLE)
    set(Burnish_FOUND FALSE)
    string(
        CONCAT Burnish_NOT_FOUND_MESSAGE
        "there is no program `burnish` on PATH: activate the Python environment in which Burnish is "
        "installed, or name the program by -DBURNISH_EXECUTABLE=PATH"
    )
    return()
endif()

include("${CMAKE_CURRENT_LIST_DIR}/BurnishMaterials.cmake")
