# illum_module(NAME <name> SOURCES … [TESTS …] [BENCHMARKS …] [USES <module>…] [PACKAGES <target>…]
#              [LOADS <target>…])
#
# One module is one folder of src/, compiled once into objects. USES names the modules whose headers
# it may include: the include path itself is one (src/), so the arrow is kept by linking each module's
# tests against nothing but the module and what it uses, all the way down. LOADS names libraries that
# are loaded while a program runs: they are built before whatever is linked with the module.
# Variables of the configuration apply to all: warnings, sanitizers.

add_library(illum_flags INTERFACE)
target_compile_options(illum_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # False alarms in std::string's own operator+ (GCC bug 105651).
  target_compile_options(illum_flags INTERFACE -Wno-restrict)
endif()
if(ILLUM_WARNINGS_AS_ERRORS)
  target_compile_options(illum_flags INTERFACE -Werror)
endif()

set_property(GLOBAL PROPERTY ILLUM_TEST_TARGETS "")

# All modules that the named ones use, themselves included.
function(illum_closure OUT)
  set(open ${ARGN})
  set(closed "")
  while(open)
    list(POP_FRONT open module)
    if(NOT module IN_LIST closed)
      list(APPEND closed ${module})
      get_property(uses GLOBAL PROPERTY ILLUM_USES_${module})
      list(APPEND open ${uses})
    endif()
  endwhile()
  set(${OUT} ${closed} PARENT_SCOPE)
endfunction()

# What is linked with the modules, and what must be there when it runs.
function(illum_link_packages TARGET)
  foreach(module IN LISTS ARGN)
    get_property(packages GLOBAL PROPERTY ILLUM_PACKAGES_${module})
    target_link_libraries(${TARGET} PRIVATE ${packages})
    get_property(loads GLOBAL PROPERTY ILLUM_LOADS_${module})
    if(loads)
      add_dependencies(${TARGET} ${loads})
    endif()
  endforeach()
endfunction()

function(illum_link_modules TARGET)
  illum_closure(modules ${ARGN})
  foreach(module IN LISTS modules)
    target_sources(${TARGET} PRIVATE $<TARGET_OBJECTS:illum_${module}>)
  endforeach()
  illum_link_packages(${TARGET} ${modules})
  target_include_directories(${TARGET} PRIVATE ${PROJECT_SOURCE_DIR}/include
                                               ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(${TARGET} PRIVATE illum_flags Threads::Threads)
endfunction()

function(illum_module)
  cmake_parse_arguments(M "" "NAME" "SOURCES;TESTS;BENCHMARKS;USES;PACKAGES;LOADS" ${ARGN})
  add_library(illum_${M_NAME} OBJECT ${M_SOURCES})
  target_include_directories(illum_${M_NAME} PRIVATE ${PROJECT_SOURCE_DIR}/include
                                                     ${PROJECT_SOURCE_DIR}/src)
  set_property(GLOBAL PROPERTY ILLUM_USES_${M_NAME} ${M_USES})
  set_property(GLOBAL PROPERTY ILLUM_PACKAGES_${M_NAME} ${M_PACKAGES})
  set_property(GLOBAL PROPERTY ILLUM_LOADS_${M_NAME} ${M_LOADS})
  illum_closure(modules ${M_NAME})
  foreach(module IN LISTS modules)
    get_property(packages GLOBAL PROPERTY ILLUM_PACKAGES_${module})
    target_link_libraries(illum_${M_NAME} PRIVATE ${packages})
  endforeach()
  target_link_libraries(illum_${M_NAME} PRIVATE illum_flags Threads::Threads)

  if(ILLUM_TESTS AND M_TESTS)
    add_executable(illum_${M_NAME}_test ${M_TESTS})
    illum_link_modules(illum_${M_NAME}_test ${M_NAME})
    target_link_libraries(illum_${M_NAME}_test PRIVATE GTest::gmock GTest::gtest_main)
    target_compile_options(illum_${M_NAME}_test PRIVATE ${ILLUM_TEST_FLAGS})
    target_compile_definitions(illum_${M_NAME}_test PRIVATE ILLUM_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    gtest_discover_tests(illum_${M_NAME}_test TEST_PREFIX ${M_NAME}. DISCOVERY_TIMEOUT 60
                         PROPERTIES LABELS unit)
  endif()
  if(ILLUM_BENCHMARKS AND M_BENCHMARKS)
    add_executable(illum_${M_NAME}_bench ${M_BENCHMARKS})
    illum_link_modules(illum_${M_NAME}_bench ${M_NAME})
    target_link_libraries(illum_${M_NAME}_bench PRIVATE benchmark::benchmark_main)
  endif()
endfunction()

# illum_library(<target> <module>…): the modules as one installed static library.
function(illum_library TARGET)
  add_library(${TARGET} STATIC)
  add_library(Illumigraph::${TARGET} ALIAS ${TARGET})
  foreach(module IN LISTS ARGN)
    target_sources(${TARGET} PRIVATE $<TARGET_OBJECTS:illum_${module}>)
  endforeach()
  illum_link_packages(${TARGET} ${ARGN})
  target_link_libraries(${TARGET} PUBLIC Threads::Threads)
  target_include_directories(${TARGET} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
endfunction()
