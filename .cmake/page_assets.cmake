# Makes page_assets.cpp: the page's scripts, its styles and the library three.js as strings; runs once as part of CMakeLists.txt and then, as a
# script, whenever one of these files changes.

if(NOT CMAKE_SCRIPT_MODE_FILE)
  # In the order in which they stand in the page: each may use what those before it define.
  set(page_scripts data sort provenance print packing_data contacts stability tones spheres_shader packing_view turning packings)
  set(page_styles page packings print)
  list(TRANSFORM page_scripts REPLACE "(.+)" "${PROJECT_SOURCE_DIR}/report/page/\\1.js")
  list(TRANSFORM page_styles REPLACE "(.+)" "${PROJECT_SOURCE_DIR}/report/page/\\1.css")
  # Debian's package libjs-three; a build without it makes pages that say what is missing.
  find_file(TAMP_THREE_JS three.min.js PATHS /usr/share/javascript/three/build NO_DEFAULT_PATH)
  set(three "")
  if(TAMP_THREE_JS)
    set(three ${TAMP_THREE_JS})
  endif()

  set(page_assets ${PROJECT_BINARY_DIR}/page_assets/page_assets.cpp)
  add_custom_command(OUTPUT ${page_assets}
    COMMAND ${CMAKE_COMMAND} "-DSCRIPTS=${page_scripts}" "-DSTYLES=${page_styles}" "-DTHREE=${three}" -DOUT=${page_assets}
            -P ${PROJECT_SOURCE_DIR}/.cmake/page_assets.cmake
    DEPENDS ${page_scripts} ${page_styles} ${three} ${PROJECT_SOURCE_DIR}/.cmake/page_assets.cmake
    COMMENT "Scripts and styles of the page into page_assets.cpp" VERBATIM)
  target_sources(tamp_report PRIVATE ${page_assets})
  return()
endif()

function(append_string name)
  set(text "")
  foreach(path ${ARGN})
    file(READ ${path} bytes)
    string(APPEND text "${bytes}")
  endforeach()
  if(text MATCHES "\\)page\"|</script")
    message(FATAL_ERROR "${name} cannot stand in a raw string and a <script> element")
  endif()
  file(APPEND ${OUT} "extern const std::string_view ${name} = R\"page(${text})page\";\n")
endfunction()

file(WRITE ${OUT} "#include \"report/page_assets.h\"\nnamespace tamp {\n")
append_string(kPageScript ${SCRIPTS})
append_string(kPageStyle ${STYLES})
append_string(kThreeJs ${THREE})
file(APPEND ${OUT} "} // namespace tamp\n")
