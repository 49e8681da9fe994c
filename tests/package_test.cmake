# Installs the build into a folder of its own, then configures, builds and tests tests/package_example against it, as
# another project would; moves a body of the scene and expects its visual test to fail; builds by pkg-config; and
# removes what was installed. Every path holds a blank. Takes `build`, `source`, `work` (a folder that may be emptied), `generator`, `compiler`,
# `build_type`, `sanitize`.

# run(TEXT command...): runs a command that must succeed; its output is left in TEXT.
function(run text)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE ending OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT ending EQUAL 0)
    message(FATAL_ERROR "${ARGN} ended with ${ending}:\n${out}")
  endif()
  set(${text} "${out}" PARENT_SCOPE)
endfunction()

function(expect text part)
  string(FIND "${text}" "${part}" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "expected \"${part}\" in:\n${text}")
  endif()
endfunction()

set(prefix ${work}/prefix)
set(example ${work}/example)
file(REMOVE_RECURSE ${work})
run(out ${CMAKE_COMMAND} --install ${build} --prefix ${prefix})
file(COPY_FILE ${build}/install_manifest.txt ${work}/installed.txt)

# The package stands on its own: nothing in it points back to the tree it came from.
file(GLOB_RECURSE package_files ${prefix}/*.cmake)
foreach(file ${package_files})
  file(READ ${file} text)
  string(FIND "${text}" "${source}" at)
  if(NOT at EQUAL -1)
    message(FATAL_ERROR "${file} names ${source}")
  endif()
endforeach()
foreach(file share/man/man1/carom.1 share/bash-completion/completions/carom
        share/zsh/site-functions/_carom share/fish/vendor_completions.d/carom.fish)
  file(SIZE ${prefix}/${file} size)
  if(size LESS 1000)
    message(FATAL_ERROR "${file} holds nothing to speak of")
  endif()
endforeach()
run(out ${prefix}/bin/carom doctor)
expect("${out}" "${prefix}/share/carom (")

file(COPY ${source}/tests/package_example/ DESTINATION ${example})
run(out ${CMAKE_COMMAND} -S ${example} -B ${example}/build -G ${generator} -DCMAKE_BUILD_TYPE=${build_type}
  -DCMAKE_CXX_COMPILER=${compiler} -DCMAKE_PREFIX_PATH=${prefix})
run(out ${CMAKE_COMMAND} --build ${example}/build)
run(out ${CMAKE_CTEST_COMMAND} --test-dir ${example}/build --output-on-failure)
expect("${out}" "100% tests passed, 0 tests failed out of 3")

# A domino 2 cm aside: the frames differ, and the test says why and how to accept them.
file(READ ${example}/dominoes.json scene)
string(REPLACE "[-0.6, 0, 0.602]" "[-0.6, 0.02, 0.602]" moved "${scene}")
if(moved STREQUAL scene)
  message(FATAL_ERROR "the scene has no such domino")
endif()
file(WRITE ${example}/dominoes.json "${moved}")
execute_process(COMMAND ${CMAKE_CTEST_COMMAND} --test-dir ${example}/build --output-on-failure -R dominoes
  RESULT_VARIABLE ending OUTPUT_VARIABLE out ERROR_VARIABLE out)
if(ending EQUAL 0)
  message(FATAL_ERROR "a moved domino passed:\n${out}")
endif()
expect("${out}" "the scene was edited")
expect("${out}" "/bin/carom' compare '${example}/build/carom/dominoes/frames' '${example}/golden/dominoes' --update")
if(NOT EXISTS ${example}/build/carom/dominoes/report.html)
  message(FATAL_ERROR "there is no report")
endif()

# The command that was printed accepts them.
run(out ${prefix}/bin/carom compare ${example}/build/carom/dominoes/frames ${example}/golden/dominoes --update)
run(out ${CMAKE_CTEST_COMMAND} --test-dir ${example}/build --output-on-failure -R dominoes)

# By pkg-config, too.
file(GLOB_RECURSE pc ${prefix}/*/carom-renderer.pc)
get_filename_component(pc "${pc}" DIRECTORY)
run(flags ${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${pc} pkg-config --cflags --libs carom-renderer)
separate_arguments(flags UNIX_COMMAND "${flags}")
if(sanitize)
  list(PREPEND flags -fsanitize=${sanitize})
endif()
run(out ${compiler} -O1 ${example}/falling_ball.cpp -o ${work}/falling_ball ${flags})
run(out ${work}/falling_ball)

# The program alone needs none of the libraries' dependencies, nor a language.
file(WRITE ${work}/program_only/CMakeLists.txt
  "cmake_minimum_required(VERSION 3.24)\nproject(p LANGUAGES NONE)\n"
  "find_package(carom REQUIRED COMPONENTS program)\n"
  "if(TARGET carom::engine OR NOT TARGET carom::carom)\n  message(FATAL_ERROR wrong)\nendif()\n")
run(out ${CMAKE_COMMAND} -S ${work}/program_only -B ${work}/program_only/build -G ${generator}
  -DCMAKE_PREFIX_PATH=${prefix})

# What was installed goes again, and its folders with it; what is another's stays.
file(WRITE ${prefix}/bin/another "another program")
run(out ${CMAKE_COMMAND} -Dmanifest=${work}/installed.txt -P ${source}/demos/package/uninstall.cmake)
file(GLOB_RECURSE left RELATIVE ${prefix} ${prefix}/*)
file(GLOB_RECURSE left_folders LIST_DIRECTORIES true RELATIVE ${prefix} ${prefix}/*)
list(FILTER left_folders INCLUDE REGEX "carom")
if(NOT left STREQUAL "bin/another" OR left_folders)
  message(FATAL_ERROR "uninstall left ${left} ${left_folders}")
endif()

# Of what is not built, nothing is installed.
run(out ${CMAKE_COMMAND} -S ${source} -B ${work}/unbuilt -G ${generator} -DCMAKE_CXX_COMPILER=${compiler}
  -DCAROM_BUILD_TESTS=OFF)
execute_process(COMMAND ${CMAKE_COMMAND} --install ${work}/unbuilt --prefix ${work}/nothing
  RESULT_VARIABLE ending OUTPUT_VARIABLE out ERROR_VARIABLE out)
string(REGEX REPLACE "[ \n]+" " " out "${out}")
expect("${out}" "is not built yet: cmake --build")
if(ending EQUAL 0 OR EXISTS ${work}/nothing)
  message(FATAL_ERROR "a build that is not there was installed:\n${out}")
endif()
file(REMOVE_RECURSE ${work})
