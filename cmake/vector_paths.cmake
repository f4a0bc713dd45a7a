# circlepoint_vector_paths(TARGET FILE...): compiles each file once for each instruction set and links all into the target; the
# code chooses at run time (core/instruction_set.hpp). These files use no Eigen: with wide vectors its types have another layout.
# Rounding as written, also where the processor could fuse a product and a sum: the paths agree, and with SciPy, bit by bit.
function(circlepoint_vector_paths target)
  set(paths baseline)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
    list(APPEND paths avx2 avx512)
  endif()
  set(width_baseline 2)
  set(width_avx2 4)
  set(width_avx512 8)
  set(flags_avx2 -mavx2)
  set(flags_avx512 -mavx2 -mavx512f -mavx512vl)
  foreach(path IN LISTS paths)
    set(objects ${target}_${path})
    add_library(${objects} OBJECT ${ARGN})
    target_compile_definitions(${objects} PRIVATE
      CIRCLEPOINT_VECTOR_WIDTH=${width_${path}} CIRCLEPOINT_VECTOR_PATH=_${path})
    target_compile_options(${objects} PRIVATE -ffp-contract=off ${flags_${path}})
    circlepoint_warnings(${objects})
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${objects}>)
  endforeach()
endfunction()
