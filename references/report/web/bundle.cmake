# The report's page: bundled by esbuild with Debian's d3, embedded as bytes.
find_program(ESBUILD esbuild)
if(NOT ESBUILD OR NOT EXISTS /usr/share/nodejs/d3-zoom/package.json)
  message(FATAL_ERROR "esbuild or d3 (expected in /usr/share/nodejs) is missing, which the report's page is bundled with: run scripts/packages")
endif()
set(report_web ${PROJECT_SOURCE_DIR}/references/report/web)
set(report_built ${PROJECT_BINARY_DIR}/report)
set(report_sources
  budget.js clipboard.js dialogs.js dom.js explanation.js format.js heat.js keys.js main.js marks.js overview.js
  pane.js picture.js pixel.js router.js scene.js shading.js slider.js stage.js status.js store.js tables.js toolbar.js
  style.css overview.css scene.css base.css document.css page.html LICENSES.md)
list(TRANSFORM report_sources PREPEND ${report_web}/)
add_custom_command(
  OUTPUT ${report_built}/web.cpp
  COMMAND ${CMAKE_COMMAND} -E env NODE_PATH=/usr/share/nodejs
          ${ESBUILD} ${report_web}/main.js ${report_web}/style.css --bundle --minify --format=iife --target=es2022
          --loader:.md=text --log-level=warning --outdir=${report_built}
  COMMAND ${CMAKE_COMMAND} -DOUTPUT=${report_built}/web.cpp -DPAGE=${report_web}/page.html
          -DSTYLE=${report_built}/style.css -DSCRIPT=${report_built}/main.js -P ${report_web}/embed.cmake
  DEPENDS ${report_sources} ${report_web}/embed.cmake
  COMMENT "Bundling the report's page"
  VERBATIM)
