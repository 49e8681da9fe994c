# cmake -Dfolder=FOLDER -Dfunction=NAME -Doutput=FILE [-Dshaders=FOLDER] -P embed_web.cmake: a C++ file that holds the
# files of a folder, and those of the renderer's shaders that a page draws with.
file(GLOB files ${folder}/*.html ${folder}/*.css ${folder}/*.js ${folder}/*.glsl)
list(SORT files)
if(shaders)
  foreach(name head light noise surface ground_pattern body_fragment glass_fragment ground_vertex ground_common
          ground_shadowed_fragment occlusion_fragment shadow_fragment sky_vertex sky_fragment)
    list(APPEND files ${shaders}/${name}.glsl)
  endforeach()
endif()
set(rows "")
foreach(file IN LISTS files)
  file(READ ${file} text)
  get_filename_component(name ${file} NAME)
  # A literal has at most 65536 characters for a compiler that keeps to the standard's least.
  string(LENGTH "${text}" length)
  set(literal "")
  set(at 0)
  while(at LESS length)
    string(SUBSTRING "${text}" ${at} 12000 part)
    math(EXPR at "${at} + 12000")
    string(APPEND literal "\n          R\"WEB(${part})WEB\"")
  endwhile()
  string(APPEND rows "      {\"${name}\",${literal}},\n")
endforeach()
set(code "#include \"demos/page/web_source.h\"\n\nnamespace carom::demos {\n
const std::vector<WebSource>& ${function}();
const std::vector<WebSource>& ${function}() {\n  static const std::vector<WebSource> sources = {\n${rows}  };\n  return sources;\n}\n
}  // namespace carom::demos\n")
file(WRITE ${output} "${code}")
