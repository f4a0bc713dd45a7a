# circlepoint_warnings(TARGET): the strict warning set every target of the project is compiled with.
function(circlepoint_warnings target)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wnon-virtual-dtor -Wold-style-cast
    -Wcast-align -Wunused -Woverloaded-virtual -Wdouble-promotion -Wformat=2
    $<$<BOOL:${CIRCLEPOINT_WERROR}>:-Werror>)
endfunction()
