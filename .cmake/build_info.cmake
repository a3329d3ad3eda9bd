# Makes tamp_build_info.h (commit, dirty flag, compiler, flags, library versions); runs once as part of CMakeLists.txt and then, as a script, in every build.

if(NOT CMAKE_SCRIPT_MODE_FILE)
  # --- Configure time: write down what does not change from build to build, and ask for the script at every build.
  string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type_upper)
  get_directory_property(options COMPILE_OPTIONS)
  list(JOIN options " " options)
  string(STRIP "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type_upper}} ${options}" flags)
  file(STRINGS ${SQLite3_INCLUDE_DIRS}/sqlite3.h sqlite_line REGEX "^#define SQLITE_VERSION ")
  string(REGEX REPLACE ".*\"(.*)\".*" "\\1" sqlite_version "${sqlite_line}")
  set(libraries "")
  foreach(pair "boost=${Boost_VERSION_STRING}" "cgal=${CGAL_VERSION}" "cli11=${CLI11_VERSION}" "eigen=${Eigen3_VERSION}" "fmt=${fmt_VERSION}"
          "hdf5=${HDF5_VERSION}" "nlohmann_json=${nlohmann_json_VERSION}" "onetbb=${TBB_VERSION}" "openssl=${OPENSSL_VERSION}"
          "spdlog=${spdlog_VERSION}" "sqlite=${sqlite_version}" "sqlitecpp=${SQLiteCpp_VERSION}")
    string(REGEX MATCH "^([^=]+)=(.*)$" unused "${pair}")
    string(APPEND libraries "    {\"${CMAKE_MATCH_1}\", \"${CMAKE_MATCH_2}\"},\n")
  endforeach()

  set(info_dir ${PROJECT_BINARY_DIR}/build_info)
  set(TAMP_VERSION ${PROJECT_VERSION})
  set(TAMP_COMPILER "${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}")
  set(TAMP_FLAGS "${flags}")
  set(TAMP_LIBRARIES "${libraries}")
  configure_file(${PROJECT_SOURCE_DIR}/.cmake/tamp_build_info.h.in ${info_dir}/tamp_build_info.h.in @ONLY)

  set(header ${info_dir}/include/tamp_build_info.h)
  add_custom_target(tamp_build_info_header
    COMMAND ${CMAKE_COMMAND} -DSOURCE_DIR=${PROJECT_SOURCE_DIR} -DTEMPLATE=${info_dir}/tamp_build_info.h.in -DHEADER=${header}
            -P ${PROJECT_SOURCE_DIR}/.cmake/build_info.cmake
    BYPRODUCTS ${header}
    COMMENT "Source commit into tamp_build_info.h" VERBATIM)
  add_library(tamp_build_info INTERFACE)
  target_include_directories(tamp_build_info INTERFACE ${info_dir}/include)
  add_dependencies(tamp_build_info tamp_build_info_header)
  return()
endif()

# --- Build time: ask git. Files that do not go into the program (tests, notes, campaign files) do not make it dirty.
set(ENV{GIT_OPTIONAL_LOCKS} 0)
execute_process(COMMAND git -C ${SOURCE_DIR} rev-parse --show-toplevel HEAD
  OUTPUT_VARIABLE answer RESULT_VARIABLE failed OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
string(REPLACE "\n" ";" answer "${answer}")
set(TAMP_COMMIT unknown)
set(TAMP_DIRTY false)
if(failed EQUAL 0)
  list(GET answer 0 top)
  file(REAL_PATH ${SOURCE_DIR} source_dir)
  file(REAL_PATH ${top} top)
  if(top STREQUAL source_dir) # else: an unpacked archive that lies inside some other checkout
    list(GET answer 1 TAMP_COMMIT)
    set(program CMakeLists.txt CMakePresets.json .cmake report/page)
    foreach(room engine store campaigns report)
      list(APPEND program ${room}/*.h ${room}/*.cpp)
    endforeach()
    execute_process(COMMAND git -C ${SOURCE_DIR} status --porcelain --untracked-files=all -- ${program} OUTPUT_VARIABLE changes)
    if(NOT changes STREQUAL "")
      set(TAMP_DIRTY true)
    endif()
  endif()
endif()
configure_file(${TEMPLATE} ${HEADER}) # leaves an unchanged header untouched, so nothing is compiled again
