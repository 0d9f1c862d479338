#define GRANUM_KERNEL sse4_kernel
#include "granum/dem/kernel/contact_loops.hpp"
#include "granum/dem/kernel/motion_loop.hpp"

namespace granum::dem::kernel
{
Kernel const& sse4()
{
    static constexpr Kernel kernel{"sse4", sse4_kernel::pairs, sse4_kernel::walls, sse4_kernel::move,
                                   sse4_kernel::look};
    return kernel;
}
}
