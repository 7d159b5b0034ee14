# How every target of Facet is built.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

# Warnings are errors, and no a*b+c is contracted into an fma: float results must not depend on
# the compiler (cl/ says the same with FP_CONTRACT OFF).
add_library(facet_options INTERFACE)
target_compile_features(facet_options INTERFACE cxx_std_20)
target_compile_options(facet_options INTERFACE
  $<BUILD_INTERFACE:-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Werror>
  # GCC 12 sees overlaps in "text" + std::to_string(n) that are not there (its bug 105651). From precompiled headers
  # it sees more, in "text" + string and push_back("text"): append and emplace_back go without.
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  -ffp-contract=off)
if(FACET_SANITIZE)
  target_compile_options(facet_options INTERFACE
    -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(facet_options INTERFACE -fsanitize=address,undefined)
endif()

# facet_computes(TARGET): it has loops that run long. Under the sanitizers nothing else is optimised, for
# that halves the time of the build.
function(facet_computes target)
  if(FACET_SANITIZE)
    target_compile_options(${target} PRIVATE -O1)
  endif()
endfunction()

# facet_reads_command_line(TARGET): what takes long lies in the libraries, and most of the time to compile these
# files is their headers' code.
function(facet_reads_command_line target)
  if(NOT FACET_SANITIZE)
    target_compile_options(${target} PRIVATE -O1)
  endif()
endfunction()

# facet_precompiles(TARGET HEADERS...): the standard headers that most files include, and HEADERS, are parsed once
# for all files of the target; that is half of the time to compile most of them.
function(facet_precompiles target)
  target_precompile_headers(${target} PRIVATE
    <algorithm> <array> <atomic> <cmath> <cstddef> <cstdint> <filesystem> <functional> <map> <memory> <optional>
    <ranges> <span> <stdexcept> <string> <string_view> <vector> ${ARGN})
endfunction()

# facet_library(NAME SOURCES ... LINKS ...): one folder of host/, included as "FOLDER/file.hpp".
function(facet_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  add_library(facet_${name} STATIC ${ARG_SOURCES})
  add_library(facet::${name} ALIAS facet_${name})
  set_target_properties(facet_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(facet_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/host> $<INSTALL_INTERFACE:include/facet>)
  target_link_libraries(facet_${name} PUBLIC facet_options ${ARG_LINKS} PRIVATE ${ARG_PRIVATE_LINKS})
  # One for all libraries where their options are the same: under the sanitizers some are optimised.
  if(FACET_SANITIZE OR name STREQUAL runtime)
    facet_precompiles(facet_${name})
  else()
    target_precompile_headers(facet_${name} REUSE_FROM facet_runtime)
  endif()
endfunction()

# What find_package(facet) brings: the libraries that need no picture files, their headers, and
# layout.h. Called once, after all folders.
function(facet_install)
  include(GNUInstallDirs)
  include(CMakePackageConfigHelpers)
  set(libraries runtime scene image reference tracer study)
  list(TRANSFORM libraries PREPEND facet_ OUTPUT_VARIABLE targets)
  install(TARGETS facet_options ${targets} EXPORT facet-targets)
  install(TARGETS facet)
  if(TARGET facet_pictures)
    install(TARGETS facet_pictures LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/facet)
  endif()
  foreach(folder ${libraries})
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/host/${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/facet
            FILES_MATCHING PATTERN "*.hpp")
  endforeach()
  install(FILES ${PROJECT_SOURCE_DIR}/cl/layout.h ${PROJECT_SOURCE_DIR}/cl/build_layout.h
                ${PROJECT_SOURCE_DIR}/cl/structure.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/facet/cl)
  set(config ${CMAKE_INSTALL_LIBDIR}/cmake/facet)
  install(EXPORT facet-targets NAMESPACE facet:: DESTINATION ${config})
  file(WRITE ${PROJECT_BINARY_DIR}/facet-config.cmake
    "include(CMakeFindDependencyMacro)\nfind_dependency(OpenCL)\n"
    "include(\${CMAKE_CURRENT_LIST_DIR}/facet-targets.cmake)\n")
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/facet-config-version.cmake
    COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/facet-config.cmake
                ${PROJECT_BINARY_DIR}/facet-config-version.cmake DESTINATION ${config})
endfunction()
