# Runs after each compile, by `cmake -P` with NOTES, the folder for notes of a file, and SOURCE, that
# file. It writes the file of dependencies that CMake reads, and touches the stamp.
#
# The compiler's own file of dependencies names the outputs, and then all files that were read. CMake
# was told of the outputs when it was configured. If there are others now, because a file that SOURCE
# imports has changed, the build fails once, and the next one configures again: nothing is overlooked.

cmake_policy(VERSION 3.25)

# A path as Make and Ninja read it. The colon of a drive of Windows stays as it is.
function(escape path result)
    set(drive "")
    if(path MATCHES "^([A-Za-z]:)(.*)$")
        set(drive "${CMAKE_MATCH_1}")
        set(path "${CMAKE_MATCH_2}")
    endif()
    string(REGEX REPLACE "(\\\\*)([ \t])" "\\1\\1\\\\\\2" path "${path}")
    string(REGEX REPLACE "([#:])" "\\\\\\1" path "${path}")
    string(REPLACE "$" "$$" path "${path}")
    set(${result} "${drive}${path}" PARENT_SCOPE)
endfunction()

file(STRINGS "${NOTES}/outputs.txt" expected)
list(POP_FRONT expected question)
set(escaped)
foreach(path IN LISTS expected)
    escape("${path}" path)
    list(APPEND escaped "${path}")
endforeach()
list(JOIN escaped " \\\n  " outputs)

file(READ "${NOTES}/made.d" rule)
string(FIND "${rule}" "${outputs}: \\\n" place)
if(place EQUAL 0)
    string(LENGTH "${outputs}" length)
    string(SUBSTRING "${rule}" ${length} -1 read)
    escape("${NOTES}/stamp" stamp)
    file(WRITE "${NOTES}/stamp.d" "${stamp}${read}")
    file(TOUCH "${NOTES}/stamp")
else()
    list(JOIN expected "\n" lines)
    file(WRITE "${NOTES}/outputs.txt" "not known\n${lines}\n")
    message(
        FATAL_ERROR
        "${SOURCE} has other outputs now than CMake knows of: build again, and they are taken up"
    )
endif()
