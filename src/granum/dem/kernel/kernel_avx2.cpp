#define GRANUM_KERNEL avx2_kernel
#include "granum/dem/kernel/contact_loops.hpp"
#include "granum/dem/kernel/motion_loop.hpp"

namespace granum::dem::kernel
{
Kernel const& avx2()
{
    static constexpr Kernel kernel{"avx2", avx2_kernel::pairs, avx2_kernel::walls, avx2_kernel::move,
                                   avx2_kernel::look};
    return kernel;
}
}
