// Marks plain loops that the compiler makes for several instruction sets, of which the program takes the widest that
// the machine has. Loops without reductions have the same bits on all of them: there is no fused multiply-add
// (-ffp-contract=off).
#pragma once

#define GRANUM_VECTORISED __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
