# Writes OUTPUT, a .cpp that holds the bytes of PAGE, STYLE and SCRIPT.
# Usage: cmake -DOUTPUT=... -DPAGE=... -DSTYLE=... -DSCRIPT=... -P embed.cmake
set(text "#include \"references/report/html/web.hpp\"\n\nnamespace plumb::report::web {\nnamespace {\n")
set(views "")
foreach(name PAGE STYLE SCRIPT)
  string(TOLOWER ${name} lower)
  file(READ ${${name}} hex HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
  string(APPEND text "constexpr unsigned char ${lower}_bytes[] = {${bytes}};\n")
  string(APPEND views "const std::string_view ${lower}(reinterpret_cast<const char*>(${lower}_bytes), sizeof ${lower}_bytes);\n")
endforeach()
string(APPEND text "}  // namespace\n${views}}  // namespace plumb::report::web\n")
file(WRITE ${OUTPUT} "${text}")
