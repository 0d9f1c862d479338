#define GRANUM_KERNEL avx512_kernel
#include "granum/dem/kernel/contact_loops.hpp"
#include "granum/dem/kernel/motion_loop.hpp"

namespace granum::dem::kernel
{
Kernel const& avx512()
{
    static constexpr Kernel kernel{"avx512", avx512_kernel::pairs, avx512_kernel::walls, avx512_kernel::move,
                                   avx512_kernel::look};
    return kernel;
}
}
