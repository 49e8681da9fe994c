# cmake -Dsource=ROOT -Doutput=FILE -P source_prints.cmake: a C++ file with a print of every source of the program.
file(GLOB_RECURSE files RELATIVE ${source} ${source}/engine/*.cpp ${source}/engine/*.h ${source}/renderer/*.cpp
     ${source}/renderer/*.h ${source}/renderer/*.glsl ${source}/demos/*.cpp ${source}/demos/*.h)
list(SORT files)
set(rows "")
foreach(file IN LISTS files)
  file(READ ${source}/${file} text)
  string(REGEX REPLACE "//[^\n]*" "" text "${text}")
  string(REGEX REPLACE "[ \t\r\n]+" " " text "${text}")
  string(MD5 print "${text}")
  string(SUBSTRING ${print} 0 8 print)
  string(APPEND rows "      {\"${file}\", \"${print}\"},\n")
endforeach()
set(code "#include \"demos/cause/source_prints.h\"\n\nnamespace carom::demos {\n
const Facts& sourcePrints() {\n  static const Facts prints = {\n${rows}  };\n  return prints;\n}\n
}  // namespace carom::demos\n")
file(WRITE ${output} "${code}")
