# A test that renders a scene and holds its frames against golden ones:
#
#   carom_add_visual_test(NAME name SCENE scene GOLDEN folder
#     [FRAMES 0,30,60] [FPS 30] [DURATION seconds] [SIZE 320x180] [CAMERA name] [SEED number] [MESH file]
#     [TOLERANCE 2] [ALLOW_PIXELS 0] [TIMEOUT 300])
#
# SCENE is a shipped scene's name or a .json file; files and folders are relative to the current source
# folder. The rest is as in `carom render` and `carom compare`; without FRAMES all frames count. Frames are
# drawn with --portable into carom/<name>/ of the current build folder, where a failure leaves its report. The
# first golden frames are made, as later ones are accepted, by the command that a failure prints.

set(_carom_visual_test_run ${CMAKE_CURRENT_LIST_DIR}/carom-visual-test-run.cmake)

# Appends "option value" to the list when the value was given.
function(_carom_append_option list option value)
  if(NOT value STREQUAL "")
    set(${list} ${${list}} ${option} ${value} PARENT_SCOPE)
  endif()
endfunction()

# The list as the arguments of set(), whatever characters they hold.
function(_carom_quote result)
  set(quoted "")
  foreach(word ${ARGN})
    string(APPEND quoted " [==[${word}]==]")
  endforeach()
  set(${result} "${quoted}" PARENT_SCOPE)
endfunction()

function(carom_add_visual_test)
  set(needed NAME SCENE GOLDEN)
  set(optional FRAMES FPS DURATION SIZE CAMERA SEED MESH TOLERANCE ALLOW_PIXELS TIMEOUT)
  cmake_parse_arguments(PARSE_ARGV 0 V "" "${needed};${optional}" "")
  if(V_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "carom_add_visual_test: unknown \"${V_UNPARSED_ARGUMENTS}\"; accepted: ${needed};${optional}")
  endif()
  foreach(key ${needed})
    if(NOT V_${key})
      message(FATAL_ERROR "carom_add_visual_test: ${key} is missing")
    endif()
  endforeach()
  if(NOT V_NAME MATCHES "^[-A-Za-z0-9_.]+$")
    message(FATAL_ERROR "carom_add_visual_test: NAME ${V_NAME}: accepted: letters, digits, - _ and .")
  endif()
  if(NOT V_SIZE)
    set(V_SIZE 320x180)
  endif()
  if(NOT V_TIMEOUT)
    set(V_TIMEOUT 300)
  endif()

  if(V_SCENE MATCHES "/|\\.json$")
    get_filename_component(V_SCENE "${V_SCENE}" ABSOLUTE)
  endif()
  get_filename_component(V_GOLDEN "${V_GOLDEN}" ABSOLUTE)
  if(V_MESH)
    get_filename_component(V_MESH "${V_MESH}" ABSOLUTE)
  endif()
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/carom/${V_NAME})
  set(program $<TARGET_FILE:carom::carom>)
  set(render ${program} render ${V_SCENE} --portable -q -o ${folder}/frames/frame_%04d.png)
  foreach(key FRAMES FPS DURATION SIZE CAMERA SEED MESH)
    string(TOLOWER ${key} option)
    _carom_append_option(render --${option} "${V_${key}}")
  endforeach()
  set(compare ${program} compare ${folder}/frames ${V_GOLDEN})
  _carom_append_option(compare --tolerance "${V_TOLERANCE}")
  _carom_append_option(compare --allow-pixels "${V_ALLOW_PIXELS}")

  _carom_quote(quoted_render ${render})
  _carom_quote(quoted_compare ${compare})
  file(GENERATE OUTPUT ${folder}/test-$<CONFIG>.cmake CONTENT
"set(folder [==[${folder}]==])
set(render${quoted_render})
set(compare${quoted_compare})
include([==[${_carom_visual_test_run}]==])
")
  add_test(NAME ${V_NAME} COMMAND ${CMAKE_COMMAND} -P ${folder}/test-$<CONFIG>.cmake)
  set_tests_properties(${V_NAME} PROPERTIES TIMEOUT ${V_TIMEOUT})
endfunction()
