# Warnings for everything of ours, and the flags of each purpose.
add_library(granum_flags INTERFACE)
target_compile_options(granum_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wno-missing-field-initializers)
# No fused multiply-add behind our back: the same source gives the same bits on every x86-64 machine.
target_compile_options(granum_flags INTERFACE -ffp-contract=off)
# sqrt need not set errno, so the compiler may use the instruction; NaN and infinity keep their meaning.
target_compile_options(granum_flags INTERFACE -fno-math-errno)
set(CMAKE_CXX_FLAGS_RELEASE "-O3")
set(CMAKE_CXX_FLAGS_AUDIT "-O2 -g -DGRANUM_CHECKS=1 -D_GLIBCXX_ASSERTIONS")
set(CMAKE_CXX_FLAGS_DEBUG "-O0 -g -DGRANUM_CHECKS=1 -D_GLIBCXX_ASSERTIONS")
