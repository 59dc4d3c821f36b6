# Writes the files SHADERS (paths below DIRECTORY) as the table of sim/gpu/gl.h into the C file OUTPUT.
set(arrays "")
set(table "")
set(number 0)
foreach(shader IN LISTS SHADERS)
  file(READ "${DIRECTORY}/${shader}" bytes HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
  string(APPEND arrays "static const char shader_${number}[] = {${bytes}0};\n")
  string(APPEND table "    {\"${shader}\", shader_${number}},\n")
  math(EXPR number "${number} + 1")
endforeach()
file(WRITE "${OUTPUT}" "#include \"sim/gpu/gl.h\"\n\n${arrays}\n"
     "const EmbeddedShader embedded_shaders[] = {\n${table}    {0, 0},\n};\n")
