# burnish_add_materials(TARGET FILE...
#     [TARGETS NAME[:PROFILE]...]      the languages to write; by default, those of `burnish compile`
#     [OUTPUT_DIRECTORY FOLDER]        by default `burnish/TARGET` in the current binary folder
#     [INCLUDE_DIRECTORIES FOLDER...]  folders in which imported files are looked for
#     [BINDINGS LANGUAGE...]           what `burnish bind` writes of all FILEs: cpp for TARGET.hpp,
#                                      and c for TARGET.h, which needs the library `m`
#     [EMIT FORMAT...]                 modules for drivers as well: spirv, of `glsl`; dxil, of `hlsl`
#     [OPTIONS WORD...])               more options of `burnish compile`, such as --rig Night
#
# Compiles materials whenever they, or the files that they import, have changed. TARGET is a library
# or an executable, which is then built after them and finds OUTPUT_DIRECTORY among its folders for
# headers; if there is no such target, it becomes an INTERFACE library, for others to link to.
#
# The target gets two properties: BURNISH_OUTPUTS, the list of all files that are written, and
# BURNISH_DIRECTORY, their folder.
#
# For each FILE there is a command of its own, which writes the outputs and touches a stamp. Outputs
# that do not change keep their dates, so what is made of them is not made again.

# The endings of bindings in languages that CMake builds.
set(_BURNISH_ENDING_c h)
set(_BURNISH_ENDING_cpp hpp)

include("${CMAKE_CURRENT_LIST_DIR}/BurnishOutputs.cmake")

set(_BURNISH_TAKE_OUTPUTS "${CMAKE_CURRENT_LIST_DIR}/BurnishTakeOutputs.cmake")

define_property(TARGET PROPERTY BURNISH_OUTPUTS BRIEF_DOCS "The files that Burnish writes for it")
define_property(TARGET PROPERTY BURNISH_DIRECTORY BRIEF_DOCS "The folder of these files")

function(burnish_add_materials target)
    cmake_parse_arguments(
        PARSE_ARGV 1 arg "" "OUTPUT_DIRECTORY" "TARGETS;INCLUDE_DIRECTORIES;BINDINGS;EMIT;OPTIONS"
    )
    set(files ${arg_UNPARSED_ARGUMENTS})
    if(NOT files)
        _burnish_refuse("`${target}` gets no materials: name at least one file behind it")
    endif()
    if(arg_KEYWORDS_MISSING_VALUES)
        _burnish_refuse("there is no value behind ${arg_KEYWORDS_MISSING_VALUES}")
    endif()
    foreach(word IN LISTS arg_OPTIONS)
        if(word MATCHES "^(-o|-t|--output|--target|--depfile|--depfile-target|--watch|--list-outputs)(=|$)")
            _burnish_refuse("OPTIONS cannot have ${word}, which CMake decides on")
        endif()
    endforeach()

    foreach(language IN LISTS arg_BINDINGS)
        if(NOT DEFINED _BURNISH_ENDING_${language})
            _burnish_refuse("there are no BINDINGS in ${language} for CMake, but in c and cpp")
        endif()
    endforeach()

    _burnish_use_target(${target} scope)
    if(NOT arg_OUTPUT_DIRECTORY)
        set(arg_OUTPUT_DIRECTORY "burnish/${target}")
    endif()
    cmake_path(ABSOLUTE_PATH arg_OUTPUT_DIRECTORY BASE_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}" NORMALIZE)
    set(options ${arg_OPTIONS})
    foreach(name IN LISTS arg_TARGETS)
        list(APPEND options --target "${name}")
    endforeach()
    foreach(folder IN LISTS arg_INCLUDE_DIRECTORIES)
        cmake_path(ABSOLUTE_PATH folder BASE_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" NORMALIZE)
        list(APPEND options --include "${folder}")
    endforeach()

    # A binding takes all options but this one: it has the names of modules anyway.
    set(shared ${options})
    if(arg_EMIT)
        list(JOIN arg_EMIT "," formats)
        list(APPEND options --emit "${formats}")
    endif()

    set(sources)
    foreach(file IN LISTS files)
        cmake_path(
            ABSOLUTE_PATH file BASE_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" NORMALIZE
            OUTPUT_VARIABLE source
        )
        if(NOT EXISTS "${source}")
            _burnish_refuse("there is no file `${file}`")
        endif()
        list(APPEND sources "${source}")
    endforeach()
    _burnish_note_outputs("${sources}" "${arg_OUTPUT_DIRECTORY}" "${options}")

    set(stamps)
    set(all_outputs)
    foreach(file source IN ZIP_LISTS files sources)
        _burnish_compile("${file}" "${source}" "${arg_OUTPUT_DIRECTORY}" "${options}" stamp outputs)
        list(APPEND stamps "${stamp}")
        list(APPEND all_outputs ${outputs})
    endforeach()

    foreach(language IN LISTS arg_BINDINGS)
        _burnish_bind(
            ${language} ${target} "${sources}" "${arg_OUTPUT_DIRECTORY}" "${shared}" "${stamps}"
            stamp header
        )
        list(APPEND stamps "${stamp}")
        list(APPEND all_outputs "${header}")
    endforeach()

    get_property(count TARGET ${target} PROPERTY _BURNISH_CALLS)
    math(EXPR count "0${count} + 1")
    set_property(TARGET ${target} PROPERTY _BURNISH_CALLS ${count})
    add_custom_target(${target}_materials_${count} ALL DEPENDS ${stamps} SOURCES ${files})
    add_dependencies(${target} ${target}_materials_${count})
    target_include_directories(${target} ${scope} "$<BUILD_INTERFACE:${arg_OUTPUT_DIRECTORY}>")
    set_property(TARGET ${target} APPEND PROPERTY BURNISH_OUTPUTS ${all_outputs})
    set_property(TARGET ${target} PROPERTY BURNISH_DIRECTORY "${arg_OUTPUT_DIRECTORY}")
endfunction()

# Makes the target if there is none; `scope` is how its folders for headers are said.
function(_burnish_use_target target scope)
    if(NOT TARGET ${target})
        add_library(${target} INTERFACE)
    endif()
    get_target_property(type ${target} TYPE)
    get_target_property(is_imported ${target} IMPORTED)
    get_target_property(original ${target} ALIASED_TARGET)
    if(is_imported OR original OR type STREQUAL "UTILITY")
        _burnish_refuse("`${target}` is no library or executable of this project")
    endif()
    if(type STREQUAL "INTERFACE_LIBRARY")
        set(${scope} INTERFACE PARENT_SCOPE)
    else()
        set(${scope} PUBLIC PARENT_SCOPE)
    endif()
endfunction()

# Adds the command that compiles `source`, which the user calls `file`. `stamp` is what depends on it,
# `outputs` what it writes.
function(_burnish_compile file source folder options stamp outputs)
    _burnish_command("${source}" "${folder}" "${options}" compile)
    _burnish_notes("${source}" "${folder}" notes)
    _burnish_outputs("${source}" "${compile}" "${notes}" listed)
    _burnish_insist_on_own_outputs("${source}" "${listed}")
    # Another version of Burnish compiles anew.
    set(program)
    if(EXISTS "${BURNISH_EXECUTABLE}")
        set(program "${BURNISH_EXECUTABLE}")
    endif()

    add_custom_command(
        OUTPUT "${notes}/stamp"
        BYPRODUCTS ${listed}
        COMMAND ${compile} --depfile "${notes}/made.d" --format line
        COMMAND
            "${CMAKE_COMMAND}" "-DNOTES=${notes}" "-DSOURCE=${source}" -P "${_BURNISH_TAKE_OUTPUTS}"
        DEPENDS "${source}" ${program}
        DEPFILE "${notes}/stamp.d"
        COMMENT "Compiling ${file}"
        VERBATIM
    )
    set(${stamp} "${notes}/stamp" PARENT_SCOPE)
    set(${outputs} ${listed} PARENT_SCOPE)
endfunction()

# Adds the command that writes a binding of all files, behind their own commands, whose stamps say
# when one has changed. `header` is the binding.
function(_burnish_bind language target sources folder options stamps stamp header)
    set(made "${folder}/${target}.${_BURNISH_ENDING_${language}}")
    _burnish_insist_on_own_outputs("${target}" "${made}")
    _burnish_notes("${made}" "${folder}" notes)
    file(MAKE_DIRECTORY "${notes}")
    string(MAKE_C_IDENTIFIER "${target}" namespace)
    add_custom_command(
        OUTPUT "${notes}/stamp"
        BYPRODUCTS "${made}"
        COMMAND
            "${BURNISH_EXECUTABLE}" bind ${sources} --lang ${language} --namespace ${namespace}
            --output "${made}" ${options}
        COMMAND "${CMAKE_COMMAND}" -E touch "${notes}/stamp"
        DEPENDS ${stamps}
        COMMENT "Binding ${target} in ${language}"
        VERBATIM
    )
    set(${stamp} "${notes}/stamp" PARENT_SCOPE)
    set(${header} "${made}" PARENT_SCOPE)
endfunction()
