# What each material becomes: CMake has to know the names of all outputs when it configures.
#
# BurnishMaterials.cmake includes this file. The names are kept beside the build, in `outputs.txt` of
# the folder for notes of each file, below the command line that was asked for them. They are asked
# for again when the file or the command line has changed.

# Ends the configuration with a message about the call in the user's file.
macro(_burnish_refuse message)
    message(FATAL_ERROR "burnish_add_materials: ${message}")
endmacro()

# The folder for notes on a file. It has a name of its own for each folder of outputs.
function(_burnish_notes file folder notes)
    string(SHA256 digest "${file};${folder}")
    string(SUBSTRING "${digest}" 0 12 digest)
    cmake_path(GET file FILENAME name)
    set(${notes} "${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/burnish/${name}-${digest}" PARENT_SCOPE)
endfunction()

# The command that compiles files.
function(_burnish_command sources folder options command)
    set(
        ${command} "${BURNISH_EXECUTABLE}" compile ${sources} --output "${folder}" ${options}
        PARENT_SCOPE
    )
endfunction()

# The outputs that are noted for a file; `is_current` says whether they are those of the command.
function(_burnish_noted source command notes is_current outputs)
    set(lines)
    if(EXISTS "${notes}/outputs.txt")
        file(STRINGS "${notes}/outputs.txt" lines)
    endif()
    list(POP_FRONT lines asked)
    set(${outputs} ${lines} PARENT_SCOPE)
    string(REPLACE ";" " " question "${command}")
    if("${asked}" STREQUAL "${question}" AND NOT "${source}" IS_NEWER_THAN "${notes}/outputs.txt")
        set(${is_current} TRUE PARENT_SCOPE)
    else()
        set(${is_current} FALSE PARENT_SCOPE)
    endif()
endfunction()

# Notes outputs, below the command that was asked for them, or `not known`.
function(_burnish_note asked notes outputs)
    string(REPLACE ";" " " question "${asked}")
    list(JOIN outputs "\n" lines)
    file(WRITE "${notes}/outputs.txt" "${question}\n${lines}\n")
endfunction()

# Notes the outputs of all files that need it by one run of the program, which takes a fraction of
# the time of a run for each. If there is a mistake in any file, nothing is noted here.
function(_burnish_note_outputs sources folder options)
    set(asked)
    foreach(source IN LISTS sources)
        _burnish_command("${source}" "${folder}" "${options}" command)
        _burnish_notes("${source}" "${folder}" notes)
        _burnish_noted("${source}" "${command}" "${notes}" is_current outputs)
        if(NOT is_current)
            list(APPEND asked "${source}")
        endif()
    endforeach()
    list(LENGTH asked count)
    if(count LESS 2)
        return()
    endif()

    _burnish_command("${asked}" "${folder}" "${options}" command)
    execute_process(
        COMMAND ${command} --list-outputs --format json
        OUTPUT_VARIABLE answer
        ERROR_QUIET
        RESULT_VARIABLE status
    )
    if(NOT status EQUAL 0)
        return()
    endif()
    string(JSON rows GET "${answer}" result outputs)
    string(JSON count LENGTH "${rows}")
    set(number 0)
    while(number LESS count)
        string(JSON source GET "${rows}" ${number} source)
        string(JSON path GET "${rows}" ${number} path)
        string(SHA256 key "${source}")
        list(APPEND outputs_of_${key} "${path}")
        math(EXPR number "${number} + 1")
    endwhile()
    foreach(source IN LISTS asked)
        _burnish_command("${source}" "${folder}" "${options}" command)
        _burnish_notes("${source}" "${folder}" notes)
        string(SHA256 key "${source}")
        _burnish_note("${command}" "${notes}" "${outputs_of_${key}}")
    endforeach()
endfunction()

# The outputs of a file. While there is a mistake in it, they are those of last time: the build tells
# the mistake.
function(_burnish_outputs source command notes outputs)
    set_property(
        DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${source}" "${notes}/outputs.txt"
    )
    _burnish_noted("${source}" "${command}" "${notes}" is_current noted)
    if(NOT is_current)
        execute_process(
            COMMAND ${command} --list-outputs
            OUTPUT_VARIABLE printed
            ERROR_VARIABLE said
            RESULT_VARIABLE status
        )
        if(status EQUAL 0)
            string(REPLACE "\n" ";" noted "${printed}")
            list(REMOVE_ITEM noted "")
            _burnish_note("${command}" "${notes}" "${noted}")
        elseif(status EQUAL 1)
            _burnish_note("not known" "${notes}" "${noted}")
        else()
            _burnish_refuse("`${BURNISH_EXECUTABLE}` does not take its command line:\n${said}")
        endif()
    endif()
    set(${outputs} ${noted} PARENT_SCOPE)
endfunction()

# Ends the configuration if another call writes one of the files, too.
function(_burnish_insist_on_own_outputs source outputs)
    foreach(path IN LISTS outputs)
        string(SHA256 key "${path}")
        get_property(owner GLOBAL PROPERTY "_BURNISH_OWNER_${key}")
        if(owner)
            _burnish_refuse(
                "`${path}` would be written for `${source}` and for `${owner}`: give one of them \
another OUTPUT_DIRECTORY"
            )
        endif()
        set_property(GLOBAL PROPERTY "_BURNISH_OWNER_${key}" "${source}")
    endforeach()
endfunction()
